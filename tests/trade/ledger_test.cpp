// The record of a sweep, torn and resumed.

#include <cmath>

#include <catch2/catch.hpp>

#include "base/error.h"
#include "tests/trade/trade_fixtures.h"
#include "trade/folder.h"
#include "trade/ledger.h"

using namespace tessera;
using namespace tessera::trade;
using Catch::Contains;

namespace {

const Identity identity{{"scene hash", "abc"}, {"renderer", "1"}};

}  // namespace

TEST_CASE("a ledger gives back what was appended, unknown numbers included") {
  const TestFolder folder;
  Measurement first = measurement("spp=4", 0, 0.125, 1.0 / 3.0), second;
  first.peak_bytes = uint64_t(5) << 40;
  second.label = "hider=\"bbox\"\nspp=4";
  second.error = "ended by signal 11";
  {
    Ledger ledger(folder / "l", identity);
    ledger.append(first);
    ledger.append(second);
  }
  const LedgerContent content = read_ledger(folder / "l");
  CHECK(content.identity == identity);
  CHECK_FALSE(content.torn);
  REQUIRE(content.measurements.size() == 2);
  CHECK(content.measurements[0].frame_s == 0.125);
  CHECK(content.measurements[0].rel_mse == 1.0 / 3.0);
  CHECK(content.measurements[0].peak_bytes == uint64_t(5) << 40);
  CHECK(content.measurements[0].ok);
  CHECK(content.measurements[1].label == second.label);
  CHECK(content.measurements[1].error == second.error);
  CHECK(std::isnan(content.measurements[1].frame_s));
}

TEST_CASE("a line torn at any byte is left out, and the ledger goes on from there") {
  const TestFolder folder;
  size_t whole = 0;
  {
    Ledger ledger(folder / "l", identity);
    ledger.append(measurement("spp=4", 0, 1, 1));
    whole = text_in(folder / "l").size();
    ledger.append(measurement("spp=8", 0, 2, 2));
  }
  const std::string text = text_in(folder / "l");
  for (size_t length = whole + 1; length < text.size(); length += 7) {
    folder.write("torn", text.substr(0, length));
    const LedgerContent content = read_ledger(folder / "torn");
    REQUIRE(content.torn);
    REQUIRE(content.measurements.size() == 1);
    Ledger(folder / "torn", content).append(measurement("spp=16", 0, 3, 3));
    const LedgerContent after = read_ledger(folder / "torn");
    REQUIRE_FALSE(after.torn);
    REQUIRE(after.measurements.size() == 2);
    REQUIRE(after.measurements[1].label == "spp=16");
  }
}

TEST_CASE("anything else that is no ledger is an error with its line") {
  const TestFolder folder;
  CHECK_THROWS_AS(read_ledger(folder / "none"), Error);
  CHECK_THROWS_WITH(read_ledger(folder.write("a", "half a li")), Contains("--fresh"));
  CHECK_THROWS_WITH(read_ledger(folder.write("b", "{}\n")), Contains("b:1"));
  { Ledger ledger(folder / "c", identity); }
  const std::string head = text_in(folder / "c");
  CHECK_THROWS_WITH(read_ledger(folder.write("d", head + "nonsense\n")), Contains("d:2"));
  CHECK_THROWS_WITH(read_ledger(folder.write("e", head + "{\"label\":1}\n")), Contains("e:2"));
}

TEST_CASE("a ledger of another sweep is refused with everything that differs") {
  CHECK_NOTHROW(check_identity("l", identity, identity));
  CHECK_NOTHROW(check_identity("l", identity, {{"renderer", "1"}}));
  CHECK_THROWS_WITH(check_identity("l", identity, {{"scene hash", "abd"}, {"renderer", "2"}}),
                    Contains("was 'abc', is 'abd'") && Contains("renderer: was '1', is '2'"));
  CHECK_THROWS_WITH(check_identity("l", identity, {{"reference", "x"}}), Contains("was 'none'"));
}

TEST_CASE("repeats make one run: medians of times, and a failed one when a bit differs") {
  const std::vector<Configuration> all{configuration({}, 4)};
  std::vector<Measurement> parts;
  for (const double frame_s : {3.0, 1.0, 2.5})
    parts.push_back(measurement("spp=4", int(parts.size()), frame_s, 0.5));
  parts[2].peak_bytes = 77;
  Run run = gather_runs(all, parts)[0];
  CHECK(run.ok());
  CHECK(run.result.frame_s == 2.5);
  CHECK(run.result.peak_bytes == 77);
  CHECK(run.spread() == Approx(0.5 * (3.0 - 1.0) / 2.5));
  parts[1].pixels = "other";
  run = gather_runs(all, parts)[0];
  CHECK_FALSE(run.ok());
  CHECK_THAT(run.result.error, Contains("repeat 2 gave another image"));
  CHECK_FALSE(gather_runs(all, {})[0].measured);
}

TEST_CASE(
    "a repeat that failed leaves the good ones their row, and one that went well replaces it") {
  const std::vector<Configuration> all{configuration({}, 4)};
  std::vector<Measurement> parts{measurement("spp=4", 0, 2, 0.5), measurement("spp=4", 1, 7, 0.5),
                                 measurement("spp=4", 2, 4, 0.5)};
  parts[1].ok = false;
  parts[1].error = "no room";
  Run run = gather_runs(all, parts)[0];
  CHECK(run.ok());
  CHECK(run.frame_s_all == std::vector<double>{2, 4});
  CHECK(run.result.frame_s == 3);
  CHECK(run.failed_repeat == "repeat 2: no room");
  parts.push_back(measurement("spp=4", 1, 3.5, 0.5));
  run = gather_runs(all, parts)[0];
  CHECK(run.frame_s_all == std::vector<double>{2, 3.5, 4});
  CHECK(run.failed_repeat.empty());
  // Without the first round there is no error to give.
  parts[0].ok = false;
  parts[0].error = "too slow";
  run = gather_runs(all, parts)[0];
  CHECK_FALSE(run.ok());
  CHECK(run.result.error == "too slow");
}

TEST_CASE("a folder with runs is kept unless it is said otherwise, and what is no sweep is kept") {
  const TestFolder folder;
  const std::string output = folder / "deep/out";
  (void)prepare_folder(output, false, false);
  const std::string image = folder.write("deep/out/runs/0001.exr", "image");
  (void)prepare_folder(output, false, true);
  CHECK(text_in(image) == "image");
  folder.write("deep/out/runs.jsonl", "{}\n");
  CHECK_THROWS_WITH((void)prepare_folder(output, false, false), Contains("--resume"));
  (void)prepare_folder(output, true, false);
  CHECK(text_in(image) == "image");
  (void)prepare_folder(output, false, true);
  CHECK_FALSE(std::filesystem::exists(image));
  CHECK_FALSE(std::filesystem::exists(folder / "deep/out/runs.jsonl"));
  CHECK(std::filesystem::is_directory(folder / "deep/out/runs"));
  CHECK_THROWS_WITH((void)prepare_folder(folder.write("file", ""), false, false),
                    Contains("no folder"));
}

TEST_CASE("a folder is one sweep's at a time, and free when that ends") {
  const TestFolder folder;
  {
    const FolderLock lock = prepare_folder(folder / "out", false, false);
    CHECK_THROWS_WITH((void)prepare_folder(folder / "out", true, false), Contains("another sweep"));
    // Nor does it forget what the other is writing.
    folder.write("out/runs.jsonl", "{}\n");
    CHECK_THROWS_WITH((void)prepare_folder(folder / "out", false, true), Contains("another sweep"));
    CHECK(std::filesystem::exists(folder / "out/runs.jsonl"));
    CHECK_NOTHROW((void)prepare_folder(folder / "elsewhere", false, false));
  }
  CHECK_NOTHROW((void)prepare_folder(folder / "out", true, false));
}
