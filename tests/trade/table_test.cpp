// The files of a sweep, from runs that are made up.

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/trade/trade_fixtures.h"
#include "trade/against.h"
#include "trade/table.h"

using namespace tessera::trade;
using Catch::Contains;

TEST_CASE("runs that failed are told from those that were never run") {
  TradeTable table;
  table.runs = {run({}, 4, 1, 0.1), run({}, 16, 4, 0.1), run({}, 64, 16, 0.1)};
  table.runs[1].result.ok = false;
  table.runs[1].result.error = "crashed";
  table.runs[2] = Run();
  table.runs[2].configuration = configuration({}, 64);
  const auto runs = json_of(table).at("runs");
  CHECK(runs[0]["not_run"] == false);
  CHECK(runs[1]["not_run"] == false);
  CHECK(runs[2]["not_run"] == true);
  for (const int i : {0, 1, 2}) CHECK(runs[size_t(i)]["ok"] == (i == 0));
  const std::string csv = csv_of(table.runs);
  CHECK_THAT(csv, Catch::StartsWith("id,label,state,ok,error,"));
  CHECK_THAT(csv, Contains(",\"spp=4\",ok,1,\"\",") &&
                      Contains(",\"spp=16\",failed,0,\"crashed\",") &&
                      Contains(",\"spp=64\",not run,0,\"\","));
  // As many cells as the header has names.
  const auto commas = [&csv](size_t line) {
    size_t start = 0;
    for (; line > 0; --line) start = csv.find('\n', start) + 1;
    return std::count(csv.begin() + std::ptrdiff_t(start),
                      csv.begin() + std::ptrdiff_t(csv.find('\n', start)), ',');
  };
  for (const size_t line : {1u, 2u, 3u}) CHECK(commas(line) == commas(0));
}

TEST_CASE("the table of baselines names the samples that its numbers are of") {
  const Turn box{"hider", "bbox"};
  std::vector<Run> runs{run({}, 4, 1, 0.1), run({}, 16, 4, 0.03), run(box, 4, 2, 0.1)};
  const std::vector<Baseline> baselines{{"bbox", box, "boxes"}};
  const auto notes = [&] { return against_table(runs, baselines, 16, {}).at("notes").dump(); };
  CHECK_THAT(notes(), Contains("at 16 samples per pixel") && !Contains("nearest"));
  runs[1].measured = false;
  CHECK_THAT(notes(), Contains("at 4 samples per pixel") && Contains("relMSE at 4 samples") &&
                          Contains("no run at 16 samples") && Contains("4 are the nearest"));
  CHECK(against_table(runs, baselines, 16, {}).at("rows")[1][2] == 0.1);
}
