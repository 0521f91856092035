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

std::vector<std::pair<std::string, std::string>> render_heat_maps(
    const Renderer& renderer, const std::vector<const Run*>& runs, const std::string& folder,
    const std::function<bool()>& cancelled) {
  std::vector<std::pair<std::string, std::string>> done;
  for (const Run* run : runs) {
    for (const std::string measure : measures) {
      if (cancelled()) return done;
      const std::string& id = run->configuration.id;
      const std::string stem = (fs::path(folder) / fmt::format("{}.{}", id, measure)).string();
      std::vector<std::string> options = run->configuration.options;
      options.insert(options.end(), {"--heatmap", measure});
      if (renderer.render(options, stem + ".exr", renderer.timeout_s()).failure.empty())
        done.emplace_back(id, measure);
      // The picture in false colours is made again by whoever shows the map.
      std::error_code ignored;
      fs::remove(fmt::format("{}.{}.png", stem, measure), ignored);
    }
  }
  return done;
}

}  // namespace tessera::trade
