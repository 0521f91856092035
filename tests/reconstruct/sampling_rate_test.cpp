#include "reconstruct/sampling_rate.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <catch2/catch.hpp>

using namespace tessera;

namespace {

double bound(AxisWedge x, AxisWedge y = {}) {
  const EffectWedges wedges{x, y};
  return samples_by_bound({&wedges, 1});
}

/// By search: the fewest samples along an axis for which no replica of the wedge, cut to what the
/// filter passes in x, reaches what it passes in y. Replicas of the line at shift d are shifted by
/// multiples of pi * samples.
double searched_samples(double d_min, double d_max) {
  const double pass_y = 4,
               pass_x = d_min > 0 ? std::min(std::numbers::pi, 4 / d_min) : std::numbers::pi;
  for (double samples = 1;; samples += 1e-3) {
    bool clear = true;
    for (int replica = -3; replica <= 3; ++replica) {
      if (replica == 0) continue;
      for (int step = 0; step <= 8; ++step)
        for (const double x : {-pass_x, -pass_x / 2, 0.0, pass_x / 2, pass_x})
          clear &= std::abs((d_min + (d_max - d_min) * step / 8) * x +
                            replica * std::numbers::pi * samples) >= pass_y - 1e-9;
    }
    if (clear) return samples;
  }
}

}  // namespace

TEST_CASE("The sampling-rate bound keeps replicas out of the filter", "[sampling_rate]") {
  for (const auto& [low, high] : std::vector<std::pair<float, float>>{
           {1, 1}, {0.5f, 8}, {2, 3}, {0.1f, 0.4f}, {5, 40}, {0, 4}}) {
    CAPTURE(low, high);
    const double expected = searched_samples(low, high);
    CHECK(bound({low, high}) == Approx(expected).margin(4e-3));
    CHECK(bound({-high, -low}) == Approx(expected).margin(4e-3));
    CHECK(bound({low, high}, {low, high}) == Approx(expected * expected).epsilon(0.01));
  }
}

TEST_CASE("A wedge with both signs is bounded by its larger side and the pixels",
          "[sampling_rate]") {
  CHECK(bound({-2, 5}) == Approx((4 + 5 * std::numbers::pi) / std::numbers::pi));
  CHECK(bound({-5, 2}) == bound({-2, 5}));
}

TEST_CASE("A second effect narrows the filter of the first", "[sampling_rate]") {
  const EffectWedges shadow{{0.5f, 8}, {}}, lens{{10, 10}, {}};
  const EffectWedges both[] = {shadow, lens};
  const double bandwidth = 4.0 / 10;
  CHECK(samples_by_bound(both) ==
        Approx((4 + 8 * bandwidth) / std::numbers::pi * (4 + 10 * bandwidth) / std::numbers::pi));
}

TEST_CASE("The sampling-rate bound is finite for any wedge", "[sampling_rate]") {
  const float infinity = std::numeric_limits<float>::infinity();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  CHECK(samples_by_bound({}) == 1.0);
  for (const float shift : {0.0f, 1e-30f, 1e30f, infinity, nan}) {
    CAPTURE(shift);
    for (const AxisWedge& wedge :
         {AxisWedge{0, shift}, AxisWedge{-shift, shift}, AxisWedge{shift, shift}}) {
      CHECK(bound(wedge, wedge) >= 1.0);
      CHECK(bound(wedge, wedge) <= 1e6);
    }
  }
}
