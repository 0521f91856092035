// Sentences about sweeps whose answers are known.

#include <catch2/catch.hpp>

#include "tests/trade/trade_fixtures.h"
#include "trade/pareto.h"
#include "trade/words.h"

using namespace tessera::trade;
using Catch::Contains;

namespace {

const Turn shear{"hider", "shear"}, coarse{"shading-rate", "4"};

// The default: time spp, error 1 / spp.
std::vector<Run> default_runs(double half_span = 0) {
  std::vector<Run> runs;
  for (const int spp : {4, 16, 64}) runs.push_back(run({}, spp, spp, 1.0 / spp, half_span));
  return runs;
}

void add_runs(std::vector<Run>& runs, const Turn& turn, double time, double error,
              double half_span = 0) {
  for (const int spp : {4, 16, 64})
    runs.push_back(run(turn, spp, time * spp, error / spp, half_span));
}

std::string words_of(std::vector<Run>& runs, const std::vector<Turn>& turns,
                     double reference_rel_mse = 0) {
  mark_front(runs);
  std::string all;
  for (const std::string& sentence : describe_trade({runs, turns, 16, reference_rel_mse}))
    all += sentence + "\n";
  return all;
}

}  // namespace

TEST_CASE("the knob that buys most is named first, with its share of the time") {
  std::vector<Run> runs = default_runs();
  add_runs(runs, shear, 0.71, 1);
  add_runs(runs, coarse, 0.9, 1);
  const std::string words = words_of(runs, {coarse, shear});
  CHECK_THAT(words, Catch::StartsWith("The knob that buys most here is hider: hider=shear reaches "
                                      "the default's error at 16 samples in 0.71 of its time"));
  CHECK_THAT(words, Contains("shading-rate=4 reaches the default's error at 16 samples in 0.9 of"));
  CHECK_THAT(words,
             Contains("takes 16 times as long and relMSE falls to 1/16, as the power -1.00"));
}

TEST_CASE("when nothing is faster that is said, and what it costs") {
  std::vector<Run> runs = default_runs();
  add_runs(runs, shear, 2, 1);
  const std::string words = words_of(runs, {shear});
  CHECK_THAT(words, Catch::StartsWith("No knob but spp buys anything here"));
  CHECK_THAT(words, Contains("No knob but spp moves the front"));
  CHECK_THAT(words, Contains("in 2 times its time"));
}

TEST_CASE("differences within the noise of repeats are called that") {
  std::vector<Run> runs = default_runs(0.1);
  add_runs(runs, shear, 0.9, 1, 0.1);
  const std::string words = words_of(runs, {shear});
  CHECK_THAT(words, Catch::StartsWith("No knob but spp buys anything here"));
  CHECK_THAT(words, Contains("within noise: 0.9 of its time, known to 14 %"));
}

TEST_CASE("no verdict rests on runs that were timed once") {
  std::vector<Run> runs = default_runs();
  add_runs(runs, shear, 0.343, 1);
  add_runs(runs, coarse, 0.9, 1);
  const auto time_once = [&runs](const Turn& turn) {
    for (Run& run : runs)
      if (run.configuration.turn == turn) run.frame_s_all.resize(1);
  };
  time_once(shear);
  std::string words = words_of(runs, {shear, coarse});
  CHECK_THAT(words, Catch::StartsWith("The knob that buys most here, of what is known well "
                                      "enough, is shading-rate: shading-rate=4 reaches"));
  CHECK_THAT(words, Contains("hider=shear reached the default's error at 16 samples in 0.343 of "
                             "its time (0.343 over the ladder), timed once: that may be noise."));
  // The default's own time is a part of every ratio.
  time_once({});
  words = words_of(runs, {shear, coarse});
  CHECK_THAT(words, Catch::StartsWith("Whether a knob but spp buys anything here cannot be said"));
  CHECK_THAT(words, !Contains("buys most"));
  // Cheaper so far, but nothing says what its error takes.
  runs = default_runs();
  runs.push_back(run(shear, 4, 3, 0.25));
  words = words_of(runs, {shear});
  CHECK_THAT(words, Catch::StartsWith("Whether a knob but spp buys anything here cannot be said"));
  // What is slower however it was timed: nothing is claimed to be fast.
  runs = default_runs();
  add_runs(runs, shear, 2, 1);
  time_once(shear);
  words = words_of(runs, {shear});
  CHECK_THAT(words, Catch::StartsWith("No knob but spp buys anything here"));
}

TEST_CASE("beyond the ladder bounds are said") {
  std::vector<Run> runs = default_runs();
  add_runs(runs, coarse, 0.5, 100);
  CHECK_THAT(words_of(runs, {coarse}),
             Contains("shading-rate=4 does not come to the default's error at 16 samples within "
                      "its ladder, whose end takes 2 times the default's time") &&
                 Contains("its relMSE is 50 times the default's"));
  runs = default_runs();
  add_runs(runs, shear, 0.5, 0.01);
  CHECK_THAT(words_of(runs, {shear}), Contains("in at most 0.125 of its time"));
}

TEST_CASE("biases, references at their limit and single repeats are pointed at") {
  std::vector<Run> runs{run({}, 16, 1, 0.01), run({}, 64, 4, 0.009)};
  runs[1].limited = true;
  runs[0].frame_s_all = {1};
  const std::string words = words_of(runs, {}, 0.004);
  CHECK_THAT(words, Contains("From 16 to 64 samples the default's relMSE goes from 0.01 to 0.009"));
  CHECK_THAT(words, Contains("Runs limited by the reference, whose own relMSE is 0.004: 1"));
  CHECK_THAT(words, Contains("Runs timed once: 1"));
}

TEST_CASE("a default that failed leaves nothing to compare with") {
  std::vector<Run> runs = default_runs();
  for (Run& run : runs) run.result.ok = false;
  CHECK_THAT(words_of(runs, {}), Contains("nothing to compare with"));
}
