// What is concluded from measurements that are made up.

#include <algorithm>

#include <catch2/catch.hpp>

#include "tests/trade/trade_fixtures.h"
#include "trade/conclusion.h"

using namespace tessera::trade;
using Catch::Contains;

namespace {

std::string notes_of(const TradeTable& table) {
  std::string all;
  for (const std::string& note : table.list.notes) all += note + "\n";
  return all;
}

}  // namespace

TEST_CASE("runs as far from the reference as another scene are pointed at") {
  const auto notes = [](double rel_mse) {
    TradeTable table;
    table.list.configurations = {configuration({}, 4), configuration({}, 16)};
    SweepOutcome outcome;
    outcome.measurements = {measurement("spp=4", 0, 1, 0.01), measurement("spp=16", 0, 1, rel_mse)};
    conclude(TradeOptions(), outcome, table);
    return notes_of(table);
  };
  CHECK_THAT(notes(28.6), Contains("runs with a relMSE above 0.5: 1 (as spp=16)"));
  CHECK_THAT(notes(0.1), !Contains("relMSE above"));
}
