#include "trade/find_reference.h"

#include <filesystem>

#include <fmt/format.h>

#include "base/error.h"

namespace tessera::trade {

namespace fs = std::filesystem;

namespace {

/// Of a budget, the most that the reference may take.
constexpr double reference_share = 1.0 / 3.0;
/// Samples per pixel of the short references that tell what it costs.
constexpr int pilot_spp = 2, longer_pilot_spp = 8;

class Search {
 public:
  Search(const Renderer& renderer, const ReferenceSearch& search, std::vector<std::string>& notes)
      : renderer_(renderer), search_(search), options_(search.options), notes_(notes) {}

  Reference find();

 private:
  std::string path(const std::string& name) const {
    return (fs::path(options_.output) / name).string();
  }
  ReferenceRequest request(int spp) const;
  Pilot pilot(int spp) const;
  std::vector<Pilot> pilots() const;
  int affordable_spp();
  Reference rendered();

  const Renderer& renderer_;
  const ReferenceSearch& search_;
  const TradeOptions& options_;
  std::vector<std::string>& notes_;
};

ReferenceRequest Search::request(int spp) const {
  ReferenceRequest request;
  request.spp = spp;
  request.cache = options_.cache;
  request.folder = options_.output;
  request.scene_hash = search_.scene_hash;
  request.left_s = search_.left_s;
  request.say = search_.say;
  return request;
}

Pilot Search::pilot(int spp) const {
  const std::string image = path("probe_reference.exr");
  std::vector<std::string> options = reference_options(options_.common);
  options.insert(options.end(), {"--spp", std::to_string(spp)});
  const Rendered rendered = renderer_.render(options, image, search_.left_s());
  std::error_code ignored;
  fs::remove(image, ignored);
  if (!rendered.failure.empty())
    throw Error(fmt::format("the reference could not be rendered: {}", rendered.failure));
  return {spp, rendered.process.wall_s};
}

/// A second one only where it is not what the budget is spent on.
std::vector<Pilot> Search::pilots() const {
  std::vector<Pilot> pilots{pilot(pilot_spp)};
  if (longer_pilot_spp * pilots[0].wall_s < reference_share * *options_.budget_s)
    pilots.push_back(pilot(longer_pilot_spp));
  return pilots;
}

int Search::affordable_spp() {
  const int usual = search_.usual_spp;
  if (is_cached(renderer_, request(usual))) return usual;
  const std::vector<Pilot> known = pilots();
  const double most_s = reference_share * *options_.budget_s;
  int spp = usual;
  while (spp > 2 * pilot_spp && predict_reference_s(known, spp) > most_s) spp /= 2;
  if (spp < usual)
    notes_.push_back(fmt::format(
        "the reference has {} samples per pixel rather than {}, to fit the budget", spp, usual));
  return spp;
}

Reference Search::rendered() {
  const double left_s = search_.left_s();
  const bool choose = options_.budget_s && !options_.reference_spp;
  const int spp = choose ? affordable_spp() : options_.reference_spp.value_or(search_.usual_spp);
  Reference reference = make_reference(renderer_, request(spp));
  const double took_s = left_s - search_.left_s();
  if (options_.budget_s && !choose && took_s > reference_share * *options_.budget_s)
    notes_.push_back(fmt::format("the reference took {:.0f} s of the budget's {:.0f} s", took_s,
                                 *options_.budget_s));
  return reference;
}

Reference Search::find() {
  if (!options_.reference.empty())
    return take_reference(options_.reference, path("probe.exr"), search_.scene_hash);
  if (!search_.kept_hash.empty() && !options_.reference_spp)
    if (auto kept = kept_reference(renderer_, path("reference.exr"), search_.kept_hash))
      return *std::move(kept);
  return rendered();
}

}  // namespace

Reference find_reference(const Renderer& renderer, const ReferenceSearch& search,
                         std::vector<std::string>& notes) {
  return Search(renderer, search, notes).find();
}

}  // namespace tessera::trade
