#include "trade/conclusion.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "base/error.h"
#include "engine/frame_files.h"
#include "report/report.h"
#include "trade/against.h"
#include "trade/bench_table.h"
#include "trade/pareto.h"
#include "trade/words.h"

namespace tessera::trade {

namespace fs = std::filesystem;

namespace {

/// A run is limited by the reference when the reference's own error is more than this share of
/// what was measured.
constexpr double limiting_share = 0.25;

std::string page_of(const TradeOptions& options) {
  return (fs::path(options.report) / "index.html").string();
}

/// A black image is off by up to 1: a run that is as far from the reference as half of it shows
/// something else, most likely.
constexpr double alien_rel_mse = 0.5;

/// A warning that images and reference may not be of one scene; empty: they agree.
std::string alien_note(const std::vector<Run>& runs) {
  const auto alien = [](const Run& run) { return run.ok() && run.result.rel_mse > alien_rel_mse; };
  const auto first = std::find_if(runs.begin(), runs.end(), alien);
  if (first == runs.end()) return "";
  return fmt::format(
      "runs with a relMSE above {}: {} (as {}). Look at their images beside the reference, which "
      "may "
      "be of another scene",
      alien_rel_mse, std::count_if(first, runs.end(), alien), first->configuration.label());
}

}  // namespace

void conclude(const TradeOptions& options, const SweepOutcome& outcome, TradeTable& table) {
  table.runs = gather_runs(table.list.configurations, outcome.measurements);
  for (Run& run : table.runs)
    run.limited = run.ok() && table.reference.rel_mse > limiting_share * run.result.rel_mse;
  mark_front(table.runs);
  if (const std::string note = alien_note(table.runs); !note.empty())
    table.list.notes.push_back(note);
  for (const Run& run : table.runs)
    if (run.ok() && !run.failed_repeat.empty())
      table.list.notes.push_back(fmt::format("{}: {}; the row is of the other repeats",
                                             run.configuration.label(), run.failed_repeat));
  if (!outcome.left_out.empty())
    table.list.notes.push_back(fmt::format("not run{}: {}",
                                           outcome.cancelled ? "" : ", as the budget was spent",
                                           fmt::join(outcome.left_out, ", ")));
  if (outcome.fewer_repeats > 0)
    table.list.notes.push_back(fmt::format("{} configurations have fewer than {} repeats",
                                           outcome.fewer_repeats, options.repeats));
  table.words =
      describe_trade({table.runs, table.list.turns, table.list.pivot_spp, table.reference.rel_mse});
  if (!options.baselines.empty())
    table.tables.push_back(against_table(table.runs, table.list.baselines, table.list.pivot_spp,
                                         table.list.missing_baselines));
  for (const std::string& file : options.tables)
    table.bench_tables.push_back(read_bench_table(file));
}

void prepare_report(const TradeOptions& options) {
  if (options.report.empty()) return;
  std::error_code error;
  fs::create_directories(options.report, error);
  if (error)
    throw Error(fmt::format("--report: cannot write to {}: {}", options.report, error.message()));
  check_writable(page_of(options));
}

void write_results(const TradeOptions& options, const TradeTable& table) {
  using Json = nlohmann::ordered_json;
  const fs::path folder = options.output;
  const Json json = json_of(table);
  // What a failed run said may be anything: bytes that are no UTF-8 are replaced.
  write_text_file((folder / "trade.json").string(),
                  json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  write_text_file((folder / "trade.csv").string(), csv_of(table.runs));
  fmt::print("{}\n", text_of(table));
  for (const std::string& sentence : table.words) fmt::print("- {}\n", sentence);
  for (const Json& extra : table.tables) fmt::print("\n{}", text_of_extra(extra));
  if (options.report.empty()) return;
  write_report(json, folder, page_of(options));
}

}  // namespace tessera::trade
