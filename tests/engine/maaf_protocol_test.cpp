// Sample counts and times at equal error, against ladders that follow power laws.

#include <catch2/catch.hpp>

#include "bench/maaf_protocol.h"

using namespace tessera;

namespace {

// relMSE = 8 / spp^exponent, seconds = 0.5 spp.
std::vector<LadderStep> power_ladder(double exponent) {
  std::vector<LadderStep> ladder;
  for (const double spp : {4.0, 16.0, 64.0, 256.0})
    ladder.push_back({spp, 8 / std::pow(spp, exponent), 0.5 * spp});
  return ladder;
}

}  // namespace

TEST_CASE("equal error is found exactly between steps of a power law", "[maaf_protocol]") {
  for (const double exponent : {0.5, 1.0, 1.5})
    for (const double spp : {4.5, 16.0, 23.0, 100.0, 255.0}) {
      const auto ladder = power_ladder(exponent);
      const LadderPlace place = equal_error(ladder, 8 / std::pow(spp, exponent) * (1 + 1e-12));
      INFO("exponent " << exponent << ", " << spp << " samples");
      CHECK(place.spp == Approx(spp).epsilon(1e-6));
      CHECK(place.seconds == Approx(0.5 * spp).epsilon(1e-6));
      CHECK(place.capped == 0);
    }
}

TEST_CASE("equal error is never extrapolated", "[maaf_protocol]") {
  const auto ladder = power_ladder(1);
  const LadderPlace past = equal_error(ladder, 8 / 300.0);
  CHECK(past.spp == 256);
  CHECK(past.seconds == 128);
  CHECK(past.capped == 1);
  const LadderPlace before = equal_error(ladder, 3);
  CHECK(before.spp == 4);
  CHECK(before.seconds == 2);
  CHECK(before.capped == -1);
  const std::vector<LadderStep> one{{16, 0.1, 2}};
  CHECK(equal_error(one, 0.05).capped == 1);
  CHECK(equal_error(one, 0.1).capped == -1);
}

TEST_CASE("the first step down to the error counts where errors rise again", "[maaf_protocol]") {
  const std::vector<LadderStep> ladder{{4, 1, 1}, {16, 0.01, 2}, {64, 0.5, 4}, {256, 0.001, 8}};
  const LadderPlace place = equal_error(ladder, 0.1);
  // Half way down in logarithms: sqrt(4 * 16) samples, sqrt(1 * 2) seconds.
  CHECK(place.spp == Approx(8));
  CHECK(place.seconds == Approx(1.41421356));
  // A floor that is never left: the end of the ladder.
  const std::vector<LadderStep> floor{{4, 1, 1}, {16, 0.2, 2}, {64, 0.2, 4}};
  CHECK(equal_error(floor, 0.1).capped == 1);
  CHECK(equal_error(floor, 0.1).spp == 64);
}

TEST_CASE("a sample count finds its time on the line through the steps around it",
          "[maaf_protocol]") {
  // 2 s and half a second a sample, and a last step that takes 10 s more.
  const std::vector<LadderStep> ladder = {{4, 1, 4}, {16, 1, 10}, {64, 1, 44}};
  for (const double spp : {4.0, 5.0, 10.0, 16.0})
    CHECK(seconds_of(ladder, spp) == Approx(2 + 0.5 * spp));
  CHECK(seconds_of(ladder, 40) == Approx(27));
  CHECK(seconds_of(ladder, 64) == Approx(44));
  CHECK(seconds_of(ladder, 112) == Approx(78));
  CHECK(seconds_of(ladder, 1) == 4);
  CHECK(seconds_of(std::span(ladder).first(1), 100) == 4);
}

TEST_CASE("errors and times of zero give finite places", "[maaf_protocol]") {
  const std::vector<LadderStep> ladder{{4, 1, 0}, {16, 0, 0}, {64, 0, 1e30}};
  for (const double target : {0.0, 1e-300, 1e-30, 1e-3, 0.999}) {
    const LadderPlace place = equal_error(ladder, target);
    INFO("target " << target);
    CHECK(std::isfinite(place.spp));
    CHECK(place.spp >= 4);
    CHECK(place.spp <= 16);
    CHECK(place.seconds == 0);
    CHECK(place.capped == 0);
  }
  CHECK(equal_error(ladder, 0).spp == Approx(16));  // where the error is 0, not before
  CHECK(std::isfinite(seconds_of(ladder, 32)));
}
