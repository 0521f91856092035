#include "trade/measurement.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"

namespace tessera::trade {
namespace {

using Json = nlohmann::ordered_json;

/// null stands for what is unknown.
double number(const Json& json, const char* name) {
  const Json& value = json.at(name);
  return value.is_null() ? unknown : value.get<double>();
}

/// The row of a configuration that went well at least once, from its good parts by rising round.
void summarise(const std::vector<const Measurement*>& good, Run& run) {
  run.result = *good.front();
  std::vector<double> wall_s, cpu_s;
  for (const Measurement* part : good) {
    if (part->pixels != good.front()->pixels) {
      run.result.ok = false;
      run.result.error = fmt::format(
          "repeat {} gave another image: the renderer is not deterministic here", part->round + 1);
    }
    run.frame_s_all.push_back(part->frame_s);
    wall_s.push_back(part->wall_s);
    cpu_s.push_back(part->cpu_s);
    run.result.peak_bytes = std::max(run.result.peak_bytes, part->peak_bytes);
  }
  if (!run.result.ok) return;
  run.result.frame_s = median(run.frame_s_all);
  run.result.wall_s = median(wall_s);
  run.result.cpu_s = median(cpu_s);
}

/// `parts`: by rising round, those of one round in the order in which they were run.
Run gather(const Configuration& configuration, const std::vector<const Measurement*>& parts) {
  Run run;
  run.configuration = configuration;
  if (parts.empty()) return run;
  run.measured = true;
  std::vector<const Measurement*> good;
  std::set<int> good_rounds;
  for (const Measurement* part : parts)
    if (part->ok && good_rounds.insert(part->round).second) good.push_back(part);
  // The errors are those of the first round.
  if (good_rounds.count(0)) {
    summarise(good, run);
  } else {
    run.result.error = "the repeat that measures its error is missing";
  }
  for (const Measurement* part : parts) {
    if (part->ok || good_rounds.count(part->round)) continue;
    run.failed_repeat = fmt::format("repeat {}: {}", part->round + 1, part->error);
    if (!good_rounds.count(0)) run.result = *part;
  }
  return run;
}

}  // namespace

Json Measurement::json() const {
  return {{"label", label},
          {"id", id},
          {"round", round},
          {"ok", ok},
          {"error", error},
          {"frame_s", frame_s},
          {"wall_s", wall_s},
          {"cpu_s", cpu_s},
          {"peak_bytes", peak_bytes},
          {"rays", rays},
          {"shaded_points", shaded_points},
          {"samples", samples},
          {"ste", ste},
          {"rmse", rmse},
          {"rel_mse", rel_mse},
          {"visible", visible},
          {"pixels", pixels}};
}

Measurement Measurement::from_json(const Json& json) {
  try {
    Measurement m;
    m.label = json.at("label");
    m.id = json.at("id");
    m.round = json.at("round");
    m.ok = json.at("ok");
    m.error = json.at("error");
    m.frame_s = number(json, "frame_s");
    m.wall_s = number(json, "wall_s");
    m.cpu_s = number(json, "cpu_s");
    m.peak_bytes = json.at("peak_bytes");
    m.rays = json.at("rays");
    m.shaded_points = json.at("shaded_points");
    m.samples = json.at("samples");
    m.ste = number(json, "ste");
    m.rmse = number(json, "rmse");
    m.rel_mse = number(json, "rel_mse");
    m.visible = number(json, "visible");
    m.pixels = json.at("pixels");
    return m;
  } catch (const Json::exception& error) {
    throw Error(fmt::format("not a measurement: {}", error.what()));
  }
}

double Run::spread() const {
  if (frame_s_all.size() < 2) return unknown;
  const auto [least, most] = std::minmax_element(frame_s_all.begin(), frame_s_all.end());
  return result.frame_s > 0 ? 0.5 * (*most - *least) / result.frame_s : 0;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const size_t middle = values.size() / 2;
  return values.size() % 2 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

std::vector<Run> gather_runs(const std::vector<Configuration>& configurations,
                             const std::vector<Measurement>& measurements) {
  std::vector<Run> runs;
  for (const Configuration& configuration : configurations) {
    std::vector<const Measurement*> parts;
    for (const Measurement& measurement : measurements)
      if (measurement.label == configuration.label()) parts.push_back(&measurement);
    std::stable_sort(parts.begin(), parts.end(), [](const Measurement* a, const Measurement* b) {
      return a->round < b->round;
    });
    runs.push_back(gather(configuration, parts));
  }
  return runs;
}

}  // namespace tessera::trade
