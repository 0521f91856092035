#include <catch2/catch.hpp>

#include "engine/progress.h"

using namespace tessera;

TEST_CASE("durations read like a clock") {
  CHECK(format_duration(0) == "0:00");
  CHECK(format_duration(59.6) == "1:00");
  CHECK(format_duration(754) == "12:34");
  CHECK(format_duration(3 * 3600 + 4 * 60 + 5) == "3:04:05");
  CHECK(format_duration(-1) == "0:00");
}

TEST_CASE("without a terminal there are at most ten plain lines") {
  ProgressMeter meter("scene.rib", false, 0);
  std::string all;
  int lines = 0;
  for (int done = 0; done <= 1000; ++done) {
    if (const auto text = meter.update({1, 1, done, 1000}, 0.01 * done)) {
      ++lines;
      all += *text;
    }
  }
  CHECK(lines == 10);
  CHECK(all.find('\r') == all.npos);
  // A fifth of the work took 2 s, so four fifths take 8.
  CHECK(all.find("scene.rib: 20%, 0:08 left\n") != all.npos);
  CHECK(all.find("scene.rib: 100%, 0:00 left\n") != all.npos);
}

TEST_CASE("few buckets skip lines, and none is said twice") {
  ProgressMeter meter("s", false, 0);
  CHECK_FALSE(meter.update({1, 1, 0, 3}, 0));
  CHECK(*meter.update({1, 1, 1, 3}, 1) == "s: 30%, 0:02 left\n");
  CHECK_FALSE(meter.update({1, 1, 1, 3}, 5));
  CHECK(*meter.update({1, 1, 2, 3}, 2) == "s: 60%, 0:01 left\n");
  CHECK(*meter.update({1, 1, 3, 3}, 3) == "s: 100%, 0:00 left\n");
  CHECK_FALSE(ProgressMeter("s", false, 0).update({1, 1, 0, 0}, 1));
}

TEST_CASE("a bar fits its terminal and is not redrawn too often") {
  for (int columns : {30, 80, 200}) {
    ProgressMeter meter("scene.rib", true, columns);
    int drawn = 0;
    for (int done = 0; done <= 1000; ++done) {
      if (const auto text = meter.update({1, 1, done, 1000}, 0.001 * done)) {
        ++drawn;
        REQUIRE(text->starts_with(clear_progress_bar));
        CHECK(text->size() - std::string(clear_progress_bar).size() < size_t(columns));
      }
    }
    CHECK(drawn >= 9);
    CHECK(drawn <= 12);
  }
}

TEST_CASE("each pass has a clock of its own") {
  for (const bool terminal : {false, true}) {
    ProgressMeter meter("s", terminal, 80);
    meter.update({1, 0, 0, 10}, 10);
    // A fifth of the first pass took 1 s of the 11.
    CHECK(meter.update({1, 0, 2, 10}, 11)->find("0:04 left of the pass") != std::string::npos);
    meter.update({1, 0, 10, 10}, 15);
    meter.update({2, 0, 0, 10}, 20);
    const auto text = meter.update({2, 0, 5, 10}, 23);
    REQUIRE(text);
    CHECK(text->find("s, pass 2") != std::string::npos);
    CHECK(text->find("50%") != std::string::npos);
    CHECK(text->find("0:03 left of the pass") != std::string::npos);
  }
  CHECK(*ProgressMeter("s", false, 0).update({3, 6, 1, 2}, 1) ==
        "s, pass 3 of 6: 50%, 0:00 left of the pass\n");
}

TEST_CASE("without a terminal short passes after the first say little") {
  ProgressMeter meter("s", false, 0);
  int lines = 0;
  for (int pass = 1; pass <= 20; ++pass)
    for (int done = 0; done <= 10; ++done)
      if (meter.update({pass, 20, done, 10}, 0.4 * pass + 0.04 * done)) ++lines;
  CHECK(lines >= 10 + 3);
  CHECK(lines <= 10 + 5);  // 8 s in all
}
