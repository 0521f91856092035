#include "trade/bench_table.h"

#include <catch2/catch.hpp>

#include "base/error.h"
#include "tests/trade/trade_fixtures.h"

using namespace tessera;
using namespace tessera::trade;
using Json = nlohmann::ordered_json;

TEST_CASE("rows of a benchmark become a table with every column that some row has") {
  const TestFolder folder;
  folder.write("b.json",
               R"({"command": "./tessera bench extremes --quick", "rows": [
                   {"case": "a", "worst_error": 0.5, "verdict": "pass"},
                   {"case": "b", "seen": "x", "verdict": "fail"}]})");
  const Json table = read_bench_table(folder / "b.json");
  CHECK(table["title"] == "extremes --quick");
  CHECK(table["columns"] == Json::parse(R"([{"name": "case"}, {"name": "worst_error"},
                                            {"name": "verdict"}, {"name": "seen"}])"));
  CHECK(table["rows"] == Json::parse(R"([["a", 0.5, "pass", null], ["b", null, "fail", "x"]])"));
}

TEST_CASE("what no benchmark wrote is refused by name") {
  const TestFolder folder;
  const auto message = [&](const char* content) {
    folder.write("b.json", content);
    try {
      read_bench_table(folder / "b.json");
      return std::string("accepted");
    } catch (const Error& error) {
      return std::string(error.what());
    }
  };
  for (const char* content : {"", "[]", "{", R"({"rows": []})", R"({"command": "x", "rows": [1]})",
                              R"({"command": 1, "rows": []})"})
    CHECK(message(content).find("b.json: expected what") != std::string::npos);
  CHECK_THROWS_WITH(read_bench_table(folder / "none.json"), Catch::Contains("none.json"));
}
