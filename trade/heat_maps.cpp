#include "trade/heat_maps.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

namespace tessera::trade {

namespace fs = std::filesystem;

namespace {

constexpr const char* measures[] = {"tests", "shading", "extra"};

}  // namespace

std::vector<const Run*> runs_to_map(const std::vector<Run>& runs) {
  std::vector<const Run*> defaults, chosen;
  for (const Run& run : runs)
    if (run.ok() && run.configuration.turn.is_default()) defaults.push_back(&run);
  std::sort(defaults.begin(), defaults.end(),
            [](const Run* a, const Run* b) { return a->configuration.spp < b->configuration.spp; });
  if (!defaults.empty()) chosen.push_back(defaults[defaults.size() / 2]);
  for (const Run& run : runs)
    if (run.pareto && (chosen.empty() || chosen.front() != &run)) chosen.push_back(&run);
  return chosen;
}

namespace {

class Mapper {
 public:
  Mapper(const Renderer& renderer, const HeatMapRequest& request)
      : renderer_(renderer), request_(request) {}

  void add(const Run& run, const std::string& measure);
  HeatMaps finish();

 private:
  const Renderer& renderer_;
  const HeatMapRequest& request_;
  HeatMaps maps_;
  std::vector<std::string> left_out_;
};

void Mapper::add(const Run& run, const std::string& measure) {
  const std::string& id = run.configuration.id;
  const std::string name = fmt::format("{} of {}", measure, run.configuration.label());
  const double left_s = request_.left_s();
  if (left_s < run.result.wall_s) {
    left_out_.push_back(name);
    return;
  }
  const std::string stem = (fs::path(request_.folder) / fmt::format("{}.{}", id, measure)).string();
  std::vector<std::string> options = run.configuration.options;
  options.insert(options.end(), {"--heatmap", measure});
  const Rendered rendered =
      renderer_.render(options, stem + ".exr", std::min(left_s, renderer_.timeout_s()));
  if (rendered.failure.empty()) {
    maps_.made.emplace_back(id, measure);
  } else if (rendered.process.timed_out && left_s < renderer_.timeout_s()) {
    left_out_.push_back(name);
  } else if (!rendered.process.cancelled) {
    maps_.notes.push_back(fmt::format("no heat map {}: {}", name, rendered.failure));
  }
  // The picture in false colours is made again by whoever shows the map.
  std::error_code ignored;
  fs::remove(fmt::format("{}.{}.png", stem, measure), ignored);
}

HeatMaps Mapper::finish() {
  if (!left_out_.empty())
    maps_.notes.push_back(
        fmt::format("heat maps left out, as the budget was spent: {}", fmt::join(left_out_, ", ")));
  return std::move(maps_);
}

}  // namespace

HeatMaps render_heat_maps(const Renderer& renderer, const std::vector<const Run*>& runs,
                          const HeatMapRequest& request) {
  Mapper mapper(renderer, request);
  for (const Run* run : runs)
    for (const char* measure : measures)
      if (!request.cancelled()) mapper.add(*run, measure);
  return mapper.finish();
}

}  // namespace tessera::trade
