// How many samples a frame has time for, with a made-up clock.

#include <algorithm>
#include <numeric>
#include <vector>

#include <catch2/catch.hpp>

#include "engine/time_planner.h"

using namespace tessera;

namespace {

// A frame whose passes take fixed_s + filter_s + sample_s * samples of each core, the first of them
// dice_s + cold_s more, and those of many samples `slower` times as long. Pass k has the share
// cores[k] of the cores, and those after the last of them as much.
struct MadeUpFrame {
  double setup_s = 0, dice_s = 0, cold_s = 0, fixed_s = 0, filter_s = 0, sample_s = 0, slower = 1;
  std::vector<double> cores{1};
  std::vector<int> passes{};
  double elapsed_s = 0;

  TimedPass pass(int samples) const {
    const double share = cores[std::min(passes.size(), cores.size() - 1)];
    const double many = samples > 32 ? slower : 1;
    double core_s = many * (fixed_s + sample_s * samples) + filter_s;
    if (passes.empty()) core_s += dice_s + cold_s;
    const double seconds = core_s / share;
    return {samples, seconds,          elapsed_s + seconds,
            core_s,  filter_s / share, passes.empty() ? dice_s / share : 0};
  }
  bool run(TimePlanner planner) {
    elapsed_s = setup_s;
    std::optional<int> samples = planner.first_samples();
    while (samples && passes.size() < 100) {
      const TimedPass done = pass(*samples);
      passes.push_back(*samples);
      elapsed_s = done.elapsed_s;
      samples = planner.next(done);
    }
    return planner.samples_spent();
  }
  // Those of a frame of one pass that takes `time_s`.
  double samples_at_once(double time_s) const {
    return ((time_s - setup_s - dice_s - cold_s - filter_s) / slower - fixed_s) / sample_s;
  }
  int most_samples() const { return *std::max_element(passes.begin(), passes.end()); }
  int samples() const { return std::accumulate(passes.begin(), passes.end(), 0); }
};

}  // namespace

TEST_CASE("a frame of even samples ends within a tenth of the time, whatever its passes cost") {
  for (const double time_s : {4.0, 10.0, 60.0})
    for (const double setup_s : {0.01, 0.5})
      for (const double cold_s : {0.0, 0.4})
        for (const double fixed_s : {0.0, 0.05})
          for (const double sample_s : {0.0005, 0.005, 0.03})
            for (const double slower : {0.87, 1.0, 1.15}) {
              MadeUpFrame frame{setup_s, 0, cold_s, fixed_s, 0, sample_s, slower};
              frame.run(TimePlanner(time_s, 0.01 * time_s, 1, 1 << 20));
              CAPTURE(time_s, setup_s, cold_s, fixed_s, sample_s, slower, frame.passes);
              CHECK(frame.elapsed_s < 1.1 * time_s);
              CHECK(frame.elapsed_s > 0.9 * time_s - fixed_s - sample_s);
              CHECK(frame.passes.size() <= 6);
            }
}

TEST_CASE("one pass has most of what a frame of one pass could have, whatever is not for samples") {
  // Small passes that tell what passes cost have a filter each, which is dear where time is short.
  for (const auto& [time_s, share] : {std::pair{4.0, 0.4}, {20.0, 0.8}})
    for (const double dice_s : {0.0, 1.0})
      for (const double cold_s : {0.0, 0.1})
        for (const double fixed_s : {0.0, 0.03})
          for (const double filter_s : {0.0, 0.2})
            for (const double sample_s : {0.0005, 0.02}) {
              MadeUpFrame frame{0.1, dice_s, cold_s, fixed_s, filter_s, sample_s};
              frame.run(TimePlanner(time_s, 0.01, 1, 1 << 20));
              CAPTURE(time_s, dice_s, cold_s, fixed_s, filter_s, sample_s, frame.passes);
              CHECK(frame.most_samples() > share * frame.samples_at_once(time_s));
              CHECK(frame.elapsed_s < time_s);
            }
}

TEST_CASE("little time for much that is fixed still goes to one pass") {
  // The passes that tell are a filter each: three take 0.6 s.
  MadeUpFrame frame{0, 0.3, 0.02, 0, 0.2, 0.005};
  frame.run(TimePlanner(1.5, 0.01, 1, 1024));
  CAPTURE(frame.passes);
  CHECK(frame.most_samples() >= 55);
  CHECK(frame.elapsed_s < 1.5);
}

TEST_CASE("where threads wait for cores the time is met though how long they wait changes") {
  for (const double sample_s : {0.002, 0.01})
    for (const std::vector<double>& cores : std::vector<std::vector<double>>{
             {0.5, 0.5, 0.5, 0.4, 0.5}, {0.3, 0.2, 0.3, 0.2, 0.2}, {0.5, 0.7, 0.6, 0.45, 0.4}}) {
      MadeUpFrame frame{0.1, 0.1, 0, 0.01, 0.05, sample_s, 1, cores};
      frame.run(TimePlanner(10, 0.1, 1, 1 << 20));
      CAPTURE(sample_s, cores, frame.passes);
      CHECK(frame.elapsed_s < 11);
      CHECK(frame.elapsed_s > 9);
    }
}

TEST_CASE("a frame that takes too long whatever is done has one pass of the fewest samples") {
  MadeUpFrame frame{1, 0, 0, 1, 0, 1};
  frame.run(TimePlanner(1.5, 0, 4, 1024));
  CHECK(frame.passes == std::vector<int>{4});
}

TEST_CASE("passes have multiples of what the hider asks for, and no more than the limit") {
  MadeUpFrame frame{0, 0, 0, 0, 0, 0.001};
  CHECK(frame.run(TimePlanner(10, 0, 12, 1200)));
  for (const int samples : frame.passes) CHECK(samples % 12 == 0);
  CHECK(frame.samples() == 1200);
  // Passes that take no time at all come to the limit, too.
  MadeUpFrame free{};
  CHECK(free.run(TimePlanner(10, 0, 1, 64)));
  CHECK(free.samples() == 64);
  // Where the time is spent it is not the samples that end the frame.
  MadeUpFrame dear{0, 0, 0, 0, 0, 0.01};
  CHECK_FALSE(dear.run(TimePlanner(1, 0, 1, 1200)));
}

TEST_CASE("a pass of few samples counts with others like it, and not with one of many") {
  for (const bool filtered : {false, true}) {
    CHECK(replaces_what_was_before(1, 0, filtered));
    CHECK(replaces_what_was_before(100, 10, filtered));
    CHECK_FALSE(replaces_what_was_before(20, 10, filtered));
    CHECK_FALSE(replaces_what_was_before(5, 100, filtered));
  }
  // The bias of a filtered image of few samples stays in the mean.
  CHECK(replaces_what_was_before(50, 10, true));
  CHECK_FALSE(replaces_what_was_before(50, 10, false));
}
