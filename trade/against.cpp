#include "trade/against.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "trade/curve.h"

namespace tessera::trade {
namespace {

using Json = nlohmann::ordered_json;

/// A number where it is one, text where it is a bound, null where it is unknown.
Json cell(const Reading& reading) {
  if (!reading.known()) return nullptr;
  if (reading.bound == Bound::exact) return reading.value;
  return text_of(reading);
}

/// The run of a turn with the default's samples at the pivot.
const CurvePoint* at_spp(const std::vector<CurvePoint>& curve, double spp) {
  const auto found = std::find_if(curve.begin(), curve.end(),
                                  [spp](const CurvePoint& point) { return point.spp == spp; });
  return found == curve.end() ? nullptr : &*found;
}

Json number(const CurvePoint* point, double CurvePoint::*member) {
  return point ? Json(point->*member) : Json(nullptr);
}

Json row_of(const std::string& name, const std::vector<CurvePoint>& curve,
            const std::vector<CurvePoint>& defaults, int pivot_spp) {
  const Comparison c = compare_curves(curve, defaults, double(pivot_spp));
  const CurvePoint* same = at_spp(curve, c.pivot_spp);
  return {name,
          number(same, &CurvePoint::time_s),
          number(same, &CurvePoint::rel_mse),
          cell(c.time_ratio),
          cell(c.time_ratio_ladder),
          cell(c.error_ratio),
          cell(c.error_ratio_ladder)};
}

/// Where the default is compared: at the pivot, or where it was run that is nearest.
int compared_spp(const std::vector<CurvePoint>& defaults, int pivot_spp) {
  if (defaults.empty()) return pivot_spp;
  return int(compare_curves(defaults, defaults, double(pivot_spp)).pivot_spp);
}

Json columns() {
  return {{{"name", "case"}},
          {{"name", "frame_s"}, {"unit", "s"}},
          {{"name", "rel_mse"}},
          {{"name", "time ratio"}},
          {{"name", "time ratio, ladder"}},
          {{"name", "error ratio"}},
          {{"name", "error ratio, ladder"}}};
}

}  // namespace

Json against_table(const std::vector<Run>& runs, const std::vector<Baseline>& baselines,
                   int wanted_spp, const std::vector<std::string>& missing) {
  const std::vector<CurvePoint> defaults = curve_of(runs, Turn{});
  const int pivot_spp = compared_spp(defaults, wanted_spp);
  Json rows = Json::array(), notes = Json::array();
  if (!defaults.empty()) rows.push_back(row_of("default", defaults, defaults, pivot_spp));
  for (const Baseline& baseline : baselines) {
    const std::vector<CurvePoint> curve = curve_of(runs, baseline.turn);
    const std::string name = fmt::format("{} ({})", baseline.turn.name(), baseline.what);
    if (curve.empty() || defaults.empty()) {
      rows.push_back({name, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr});
    } else {
      rows.push_back(row_of(name, curve, defaults, pivot_spp));
    }
  }
  notes.push_back(
      fmt::format("frame_s and rel_mse: at {} samples per pixel. Ratios are of the "
                  "baseline to the default: above 1, the default is better.",
                  pivot_spp));
  notes.push_back(
      fmt::format("time ratio: time to reach the default's relMSE at {} samples, over "
                  "the default's time. error ratio: relMSE after the default's time at "
                  "{} samples, over the default's. Both interpolate logarithms along "
                  "the ladder of samples; 'at least' and 'at most': beyond it.",
                  pivot_spp, pivot_spp));
  notes.push_back(
      "ladder: geometric mean over all points of the default that lie within the "
      "baseline's ladder.");
  if (pivot_spp != wanted_spp)
    notes.push_back(
        fmt::format("The default has no run at {} samples that went well: {} are the "
                    "nearest.",
                    wanted_spp, pivot_spp));
  for (const std::string& reason : missing) notes.push_back(reason);
  return {{"title", "The default against baselines"},
          {"columns", columns()},
          {"rows", rows},
          {"notes", notes}};
}

}  // namespace tessera::trade
