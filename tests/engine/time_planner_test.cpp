// How many samples a frame has time for, with a made-up clock.

#include <numeric>
#include <vector>

#include <catch2/catch.hpp>

#include "engine/time_planner.h"

using namespace tessera;

namespace {

// A frame whose passes take fixed_s + sample_s * samples, the first of them cold_s more, and those
// of many samples `slower` times as long.
struct MadeUpFrame {
  double setup_s = 0, cold_s = 0, fixed_s = 0, sample_s = 0, slower = 1;
  std::vector<int> passes{};
  double elapsed_s = 0;

  void run(TimePlanner planner) {
    elapsed_s = setup_s;
    std::optional<int> samples = planner.first_samples();
    while (samples && passes.size() < 100) {
      double seconds = fixed_s + sample_s * *samples;
      if (passes.empty()) seconds += cold_s;
      if (*samples > 32) seconds *= slower;
      passes.push_back(*samples);
      elapsed_s += seconds;
      samples = planner.next({*samples, seconds, elapsed_s});
    }
  }
  int samples() const { return std::accumulate(passes.begin(), passes.end(), 0); }
};

}  // namespace

TEST_CASE("a frame of even samples ends within a tenth of the time, whatever its passes cost") {
  for (const double time_s : {4.0, 10.0, 60.0})
    for (const double setup_s : {0.01, 0.5})
      for (const double cold_s : {0.0, 0.4})
        for (const double fixed_s : {0.0, 0.05})
          for (const double sample_s : {0.0005, 0.005, 0.03})
            for (const double slower : {1.0, 1.15}) {
              MadeUpFrame frame{setup_s, cold_s, fixed_s, sample_s, slower};
              frame.run(TimePlanner(time_s, 0.01 * time_s, 1, 1 << 20));
              CAPTURE(time_s, setup_s, cold_s, fixed_s, sample_s, slower, frame.passes);
              CHECK(frame.elapsed_s < 1.02 * time_s);
              CHECK(frame.elapsed_s > 0.9 * time_s - fixed_s - sample_s);
              CHECK(frame.passes.size() <= 12);
            }
}

TEST_CASE("a frame that takes too long whatever is done has one pass of the fewest samples") {
  MadeUpFrame frame{1, 0, 1, 1};
  frame.run(TimePlanner(1.5, 0, 4, 1024));
  CHECK(frame.passes == std::vector<int>{4});
}

TEST_CASE("passes have multiples of what the hider asks for, and no more than the limit") {
  MadeUpFrame frame{0, 0, 0, 0.001};
  frame.run(TimePlanner(10, 0, 12, 1200));
  for (const int samples : frame.passes) CHECK(samples % 12 == 0);
  CHECK(frame.samples() == 1200);
  // Passes that take no time at all come to the limit, too.
  MadeUpFrame free{};
  free.run(TimePlanner(10, 0, 1, 64));
  CHECK(free.samples() == 64);
}

TEST_CASE("a pass of few samples counts with others like it, and not with one of many") {
  CHECK(replaces_what_was_before(1, 0));
  CHECK(replaces_what_was_before(100, 10));
  CHECK_FALSE(replaces_what_was_before(20, 10));
  CHECK_FALSE(replaces_what_was_before(5, 100));
}
