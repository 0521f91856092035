// trade.json.

#include <algorithm>
#include <cmath>
#include <ctime>
#include <fstream>
#include <thread>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "trade/table.h"

namespace tessera::trade {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

std::string cpu_name() {
  std::ifstream stream("/proc/cpuinfo");
  for (std::string line; std::getline(stream, line);) {
    if (!line.starts_with("model name")) continue;
    const size_t start = line.find_first_not_of(" \t", line.find(':') + 1);
    return start == line.npos ? "" : line.substr(start);
  }
  return "";
}

Json knobs_json(const TradeTable& table) {
  Json knobs = Json::array();
  const auto add = [&](const std::string& name, std::vector<std::string> values) {
    const Knob& knob = find_knob(name);
    knobs.push_back({{"name", name},
                     {"what", knob.what},
                     {"default", default_of(knob, table.plan)},
                     {"values", std::move(values)}});
  };
  std::vector<std::string> ladder;
  for (const int spp : table.ladder) ladder.push_back(std::to_string(spp));
  add("spp", ladder);
  for (const Knob& knob : knob_table()) {
    std::vector<std::string> values;
    for (const Turn& turn : table.list.turns)
      if (turn.knob == knob.name) values.push_back(turn.value);
    if (!values.empty()) add(knob.name, values);
  }
  return knobs;
}

Json run_json(const Run& run, const TradeTable& table) {
  const Measurement& r = run.result;
  Json settings = Json::object(), all = Json::array(), heat_maps = Json::object();
  for (const auto& [name, value] : run.configuration.settings()) settings[name] = value;
  for (const double value : run.frame_s_all) all.push_back(number(value));
  for (const auto& [id, name] : table.heat_maps)
    if (id == run.configuration.id) heat_maps[name] = fmt::format("runs/{}.{}.exr", id, name);
  Json json = {
      {"id", run.configuration.id},
      {"label", run.configuration.label()},
      {"options", run.configuration.options},
      {"settings", settings},
      {"ok", run.ok()},
      {"not_run", !run.measured},
      {"error", run.measured ? r.error : std::string("not run")},
      {"frame_s", number(r.frame_s)},
      {"frame_s_all", all},
      {"wall_s", number(r.wall_s)},
      {"cpu_s", number(r.cpu_s)},
      {"peak_bytes", r.peak_bytes},
      {"rays", r.rays},
      {"shaded_points", r.shaded_points},
      {"samples", r.samples},
      {"ste", number(r.ste)},
      {"rmse", number(r.rmse)},
      {"rel_mse", number(r.rel_mse)},
      {"visible", number(r.visible)},
      {"pareto", run.pareto},
      {"limited_by_reference", run.limited},
      {"image", run.ok() ? Json(fmt::format("runs/{}.exr", run.configuration.id)) : Json()}};
  if (!heat_maps.empty()) json["heatmaps"] = heat_maps;
  return json;
}

}  // namespace

Json json_of(const TradeTable& table) {
  Json runs = Json::array();
  for (const Run& run : table.runs) runs.push_back(run_json(run, table));
  const Reference& reference = table.reference;
  Json tables = table.tables;
  for (const Json& bench : table.bench_tables) tables.push_back(bench);
  return {{"version", 1},
          {"scene", table.scene},
          {"scene_hash", table.scene_hash},
          {"software", table.software},
          {"machine", {{"cpu", cpu_name()}, {"cores", std::thread::hardware_concurrency()}}},
          {"created", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)))},
          {"reference",
           {{"file", "reference.exr"},
            {"spp", reference.spp > 0 ? Json(reference.spp) : Json(nullptr)},
            {"frame_s", number(reference.frame_s)},
            {"options", reference.options},
            {"rel_mse", number(reference.rel_mse)}}},
          {"knobs", knobs_json(table)},
          {"runs", runs},
          {"words", table.words},
          {"notes", table.list.notes},
          {"tables", tables}};
}

}  // namespace tessera::trade
