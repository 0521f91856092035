// Reading curves of time against error, against power laws.

#include <cmath>

#include <catch2/catch.hpp>

#include "tests/trade/trade_fixtures.h"
#include "trade/curve.h"

using namespace tessera::trade;

namespace {

// time = 0.25 spp, error = `scale` spp^-`power`: straight lines in logarithms, which interpolation
// has to meet everywhere, not only at the steps.
std::vector<CurvePoint> power_law(double scale, double power, double time_scale = 0.25) {
  std::vector<CurvePoint> curve;
  for (const double spp : {4.0, 16.0, 64.0})
    curve.push_back({spp, time_scale * spp, scale * std::pow(spp, -power), 0});
  return curve;
}

}  // namespace

TEST_CASE("time to reach an error, and error after a time, follow a power law between the steps") {
  const auto curve = power_law(0.3, 0.8);
  for (const double spp : {4.0, 5.0, 16.0, 23.7, 64.0}) {
    const double error = 0.3 * std::pow(spp, -0.8);
    const Reading time = time_to_reach(curve, error);
    CHECK(time.bound == Bound::exact);
    CHECK(time.value == Approx(0.25 * spp));
    const Reading reached = error_after(curve, 0.25 * spp);
    CHECK(reached.bound == Bound::exact);
    CHECK(reached.value == Approx(error));
  }
}

TEST_CASE("beyond the ladder there are bounds only") {
  const auto curve = power_law(0.3, 0.8);
  const Reading easy = time_to_reach(curve, 1), hard = time_to_reach(curve, 1e-9);
  CHECK(easy.bound == Bound::at_most);
  CHECK(easy.value == 1.0);
  CHECK(hard.bound == Bound::at_least);
  CHECK(hard.value == 16.0);
  const Reading hasty = error_after(curve, 0.1), patient = error_after(curve, 100);
  CHECK(hasty.bound == Bound::at_least);
  CHECK(hasty.value == curve.front().rel_mse);
  CHECK(patient.bound == Bound::at_most);
  CHECK(patient.value == curve.back().rel_mse);
  CHECK_FALSE(time_to_reach({}, 1).known());
  CHECK(text_of(hard) == "at least 16");
  CHECK(text_of(easy) == "at most 1");
  CHECK(text_of(Reading{}) == "-");
}

TEST_CASE("an error that rises again counts where it was first reached") {
  const std::vector<CurvePoint> curve{{4, 1, 0.1, 0}, {16, 4, 0.001, 0}, {64, 16, 0.01, 0}};
  const Reading time = time_to_reach(curve, 0.01);
  CHECK(time.bound == Bound::exact);
  CHECK(time.value == Approx(2.0));  // half of the way in logarithms
}

TEST_CASE("an image equal to the reference gives finite numbers") {
  const std::vector<CurvePoint> curve{{4, 1, 0.1, 0}, {16, 4, 0, 0}};
  CHECK(time_to_reach(curve, 0.01).value == 4.0);
  CHECK(time_to_reach(curve, 0).value == 4.0);
  CHECK(error_after(curve, 2).value == 0.0);
}

TEST_CASE("ratios of two power laws are those of their factors") {
  // Twice the error at the same samples and 3 times the time: with error as 1 / spp, equal error
  // takes 2 x 3 times the time, and the error after equal time is 2 x 3 times as large.
  const auto other = power_law(0.3, 1);
  std::vector<CurvePoint> curve;
  for (const double spp : {1.0, 4.0, 16.0, 64.0, 256.0})
    curve.push_back({spp, 0.75 * spp, 0.6 / spp, 0});
  const Comparison c = compare_curves(curve, other, 16);
  CHECK(c.pivot_spp == 16);
  for (const Reading& reading :
       {c.time_ratio, c.error_ratio, c.time_ratio_ladder, c.error_ratio_ladder}) {
    CHECK(reading.bound == Bound::exact);
    CHECK(reading.value == Approx(6.0));
  }
  CHECK_FALSE(c.within_noise());
}

TEST_CASE("a ratio is within noise when the repeats span it") {
  std::vector<CurvePoint> other = power_law(0.3, 1), curve = power_law(0.3, 1, 0.25 * 1.2);
  CHECK_FALSE(compare_curves(curve, other, 16).within_noise());
  for (CurvePoint& point : curve) point.spread = 0.15;
  for (CurvePoint& point : other) point.spread = 0.15;
  const Comparison c = compare_curves(curve, other, 16);
  CHECK(c.noise == Approx(0.15 * std::sqrt(2.0)));
  CHECK(c.time_ratio.value == Approx(1.2));
  CHECK(c.within_noise());
}
