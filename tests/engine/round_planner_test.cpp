// When a frame has had enough, with made-up errors and a made-up clock.

#include <cmath>

#include <catch2/catch.hpp>

#include "engine/round_planner.h"

using namespace tessera;

namespace {

// An error that no number of samples here comes to: the time decides.
constexpr double out_of_reach = 1e-6;

// A frame whose passes take fixed_s + sample_s * samples, and whose squared error with n samples a
// pixel is noise / n^power.
struct MadeUpFrame {
  double setup_s = 0, fixed_s = 0, sample_s = 0;
  double uneven = 1;  // how much dearer samples are where pixels have different numbers
  double noise = 1, power = 1;

  RoundsSoFar state{};
  int rounds = 0;

  void run(RoundPlanner& planner) {
    state = {};
    state.elapsed_s = setup_s;
    add(planner.first_pass_samples(), true);
    for (rounds = 1; rounds < 100; ++rounds) {
      const auto request = planner.next(state);
      if (!request) return;
      // What brings the error down as far, by the model that all frames are planned with.
      double samples = request->most_pass_samples;
      if (request->error_squared > 0) {
        const double with_one = state.error_squared * state.mean_samples / 2;
        samples = std::min(
            samples, std::max(with_one / request->error_squared, request->least_pass_samples));
      }
      add(std::max(samples, 1.0), false);
    }
  }

  void add(double samples, bool even) {
    const double pass_s = fixed_s + sample_s * samples * (even ? 1 : uneven);
    state.elapsed_s += 2 * pass_s;
    state.last_pass_s = pass_s, state.last_pass_samples = samples, state.last_pass_even = even;
    state.mean_samples += 2 * samples;
    state.error_squared = noise / std::pow(state.mean_samples, power);
  }
};

AccuracyTarget target_of(std::optional<double> error, std::optional<double> time_s,
                         double max_samples = 1024) {
  AccuracyTarget target;
  target.error = error, target.time_s = time_s, target.max_samples = max_samples;
  return target;
}

}  // namespace

TEST_CASE("an error is reached with few samples more than it takes") {
  for (const double error : {0.3, 0.1, 0.05, 0.04}) {
    for (const double power : {1.0, 1.3}) {
      RoundPlanner planner(target_of(error, {}), 1, 0);
      MadeUpFrame frame;
      frame.power = power;
      frame.run(planner);
      CHECK(planner.end() == RoundsEnd::error_reached);
      CHECK(frame.state.error_squared <= error * error);
      const double needed =
          std::max(error < 0.1 ? 8.0 : 2.0, std::pow(1 / (error * error), 1 / power));
      CHECK(frame.state.mean_samples < (power == 1 ? 1.3 : 3.0) * needed);
      CHECK(frame.rounds < 8);
    }
  }
}

TEST_CASE("an error out of reach ends at the limit of samples") {
  RoundPlanner planner(target_of(1e-3, {}, 200), 1, 0);
  MadeUpFrame frame;
  frame.run(planner);
  CHECK(planner.end() == RoundsEnd::samples_spent);
  CHECK(frame.state.mean_samples <= 200);
  CHECK(frame.state.mean_samples > 197);
}

TEST_CASE("the first passes respect a limit of few samples") {
  CHECK(RoundPlanner(target_of(0.05, {}), 1, 0).first_pass_samples() == 4);
  CHECK(RoundPlanner(target_of(0.05, {}, 5), 1, 0).first_pass_samples() == 2);
  CHECK(RoundPlanner(target_of(0.1, {}), 1, 0).first_pass_samples() == 1);
  CHECK(RoundPlanner(target_of(0.05, {}, 2), 1, 0).first_pass_samples() == 1);
  CHECK(RoundPlanner(target_of(0.1, {}, 2), 2, 0).first_pass_samples() == 2);
}

TEST_CASE("a frame ends near the time given, whatever its passes cost") {
  for (const double time_s : {3.0, 10.0, 60.0})
    for (const double setup_s : {0.01, 1.0})
      for (const double fixed_s : {0.001, 0.05})
        for (const double sample_s : {0.02, 0.05})
          for (const double uneven : {1.0, 2.0}) {
            MadeUpFrame frame{setup_s, fixed_s, sample_s, uneven};
            RoundPlanner planner(target_of(out_of_reach, time_s, 65536), 1, 0.02 * time_s);
            frame.run(planner);
            CAPTURE(time_s, setup_s, fixed_s, sample_s, uneven, frame.rounds);
            CHECK(planner.end() == RoundsEnd::time_spent);
            CHECK(frame.state.elapsed_s < 1.02 * time_s);
            CHECK(frame.state.elapsed_s > 0.88 * time_s);
          }
}

TEST_CASE("a frame with room for few samples uses it") {
  // The first two passes take 1.1 s, and two more of the least samples as much again.
  MadeUpFrame frame{0.1, 0.01, 0.49, 2.0};
  RoundPlanner planner(target_of(out_of_reach, 2.4), 1, 0);
  frame.run(planner);
  CHECK(planner.end() == RoundsEnd::time_spent);
  CHECK(frame.state.mean_samples == 4);
}

TEST_CASE("a frame that takes too long whatever is done has the least there is") {
  MadeUpFrame frame{5, 1, 1};
  RoundPlanner planner(target_of(out_of_reach, 3.0), 1, 0);
  frame.run(planner);
  CHECK(planner.end() == RoundsEnd::time_spent);
  CHECK(frame.state.mean_samples == 2);
}

TEST_CASE("of an error and a time the first to be reached ends the frame") {
  MadeUpFrame frame{0.1, 0.001, 0.01};
  RoundPlanner slow(target_of(0.001, 2.0), 1, 0);
  frame.run(slow);
  CHECK(slow.end() == RoundsEnd::time_spent);
  RoundPlanner coarse(target_of(0.3, 1000.0), 1, 0);
  frame.run(coarse);
  CHECK(coarse.end() == RoundsEnd::error_reached);
  CHECK(frame.state.elapsed_s < 10);
}

TEST_CASE("rounds are repeated as they were") {
  AccuracyTarget target;
  target.rounds = {4, 7.5, 20.25};
  RoundPlanner planner(target, 1, 0);
  CHECK(planner.first_pass_samples() == 4);
  CHECK(planner.next({})->most_pass_samples == 7.5);
  CHECK(planner.next({})->most_pass_samples == 20.25);
  CHECK_FALSE(planner.next({}));
}

TEST_CASE("what uneven samples cost is not known from even ones, and does not upset the time") {
  for (const double sample_s : {0.2, 0.3, 0.4}) {
    MadeUpFrame frame{0.01, 0.001, sample_s, 2.2};
    RoundPlanner planner(target_of(out_of_reach, 10.0), 1, 0);
    frame.run(planner);
    CAPTURE(sample_s, frame.rounds);
    CHECK(frame.state.elapsed_s < 10.2);
    CHECK(frame.state.elapsed_s > 7.5);
  }
}
