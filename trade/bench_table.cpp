#include "trade/bench_table.h"

#include <algorithm>
#include <fstream>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"

namespace tessera::trade {
namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> column_names(const Json& rows) {
  std::vector<std::string> names;
  for (const Json& row : rows)
    for (const auto& [name, value] : row.items())
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  return names;
}

Json row_of(const Json& row, const std::vector<std::string>& names) {
  Json cells = Json::array();
  for (const std::string& name : names) cells.push_back(row.value(name, Json()));
  return cells;
}

/// "./tessera bench extremes --quick" -> "extremes --quick".
std::string title_of(const std::string& command) {
  const std::string start = "./tessera bench ";
  return command.starts_with(start) ? command.substr(start.size()) : command;
}

bool is_bench_output(const Json& json) {
  return json.is_object() && json.contains("rows") && json["rows"].is_array() &&
         json.contains("command") && json["command"].is_string() &&
         std::ranges::all_of(json["rows"], [](const Json& row) { return row.is_object(); });
}

}  // namespace

Json read_bench_table(const std::string& file) {
  std::ifstream stream(file);
  if (!stream) throw Error(fmt::format("{}: cannot be read", file));
  const Json json = Json::parse(stream, nullptr, false);
  if (!is_bench_output(json))
    throw Error(fmt::format("{}: expected what ./tessera bench NAME --json writes", file));
  const std::vector<std::string> names = column_names(json["rows"]);
  Json columns = Json::array(), rows = Json::array();
  for (const std::string& name : names) columns.push_back({{"name", name}});
  for (const Json& row : json["rows"]) rows.push_back(row_of(row, names));
  const std::string command = json["command"];
  return {{"title", title_of(command)},
          {"columns", columns},
          {"rows", rows},
          {"notes", {fmt::format("measured with: {}", command)}}};
}

}  // namespace tessera::trade
