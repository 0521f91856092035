// Spreads of lens and shutter against closed forms and against integrals of the response.

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "engine/sample_spreads.h"

using namespace tessera;

namespace {

// The integral of f over [0, 1] by midpoints.
template <class F>
double integral(const F& f) {
  constexpr int parts = 20000;
  double sum = 0;
  for (int k = 0; k < parts; ++k) sum += f((k + 0.5) / parts) / parts;
  return sum;
}

}  // namespace

TEST_CASE("the spread of a lens is that of its light") {
  // A disc's coordinate has the variance 1/4.
  CHECK(lens_spread(*make_lens_profile("disc", 0, 0)) == Approx(std::sqrt(3.0) / 2).epsilon(2e-3));
  // Even light up to 0.9, fading to nothing at 1.1.
  const auto light = [](double r) {
    const double x = (r - 0.9) / 0.2;
    return x < 0 ? 1.0 : x > 1 ? 0.0 : 1 - x * x * (3 - 2 * x);
  };
  const auto moment = [&](int power) {
    return integral([&](double s) { return light(1.1 * s) * std::pow(1.1 * s, power); });
  };
  CHECK(lens_spread(*make_lens_profile("smooth", 0, 0)) ==
        Approx(std::sqrt(1.5 * moment(3) / moment(1))).epsilon(2e-3));
  // Of a regular polygon in a circle, the mean of r^2 is R^2 (2 + cos(2 pi / n)) / 6.
  for (const double rotation_degrees : {0.0, 20.0}) {
    const auto lens = make_lens_profile("polygon", 6, rotation_degrees);
    double farthest = 0;
    for (int k = 0; k < 256 * 256; ++k)
      farthest = std::max(
          farthest,
          double(glm::length(lens->sample(float(k % 256) / 256.0f, float(k / 256) / 256.0f))));
    const double mean = farthest * farthest * (2 + std::cos(M_PI / 3)) / 6;
    CHECK(lens_spread(*lens) == Approx(std::sqrt(1.5 * mean)).epsilon(1e-2));
  }
}

TEST_CASE("the spread of a shutter is that of its response") {
  CHECK(time_spread(*make_shutter_profile("box")) == Approx(0.5).epsilon(1e-5));
  for (const char* name : {"box", "trapezoid", "gaussian"}) {
    const auto shutter = make_shutter_profile(name);
    const double variance =
        integral([&](double t) { return shutter->response(t) * (t - 0.5) * (t - 0.5); });
    CAPTURE(name);
    CHECK(time_spread(*shutter) == Approx(std::sqrt(3 * variance)).epsilon(1e-3));
  }
}
