#pragma once
/// The table of a sweep: as JSON for programs (trade.json), as CSV for spreadsheets and as text.

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "trade/configurations.h"
#include "trade/measurement.h"
#include "trade/reference.h"

namespace tessera::trade {

struct TradeTable {
  std::string scene, scene_hash, software;
  Reference reference;
  ScenePlan plan;
  std::vector<KnobChoice> knobs;  ///< those that were asked for
  SweepList list;
  std::vector<int> ladder;
  std::vector<Run> runs;
  std::vector<std::string> words;
  std::vector<nlohmann::ordered_json> tables;                  ///< title, columns, rows, notes
  std::vector<nlohmann::ordered_json> bench_tables;            ///< likewise, for the page alone
  std::vector<std::pair<std::string, std::string>> heat_maps;  ///< (id of a run, measure)
};

/// The whole table, in the layout that docs/trade.md describes. Numbers that are unknown are null.
nlohmann::ordered_json json_of(const TradeTable& table);

/// One line for each run, times in seconds, memory in bytes; a header first.
std::string csv_of(const std::vector<Run>& runs);

/// The runs by rising error, the front marked, failed ones last. `reference_rel_mse` is named
/// below.
std::string text_of(const TradeTable& table);

/// A table of `tables`, its columns aligned.
std::string text_of_extra(const nlohmann::ordered_json& table);

}  // namespace tessera::trade
