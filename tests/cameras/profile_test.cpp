#include <catch2/catch.hpp>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "base/error.h"
#include "cameras/lens_profile.h"
#include "cameras/shutter_profile.h"

using namespace tessera;

namespace {

constexpr double pi = std::numbers::pi;

/// Share of the energy within `band` (cycles per unit) of a function given by `values` at spacing
/// `step`, by a plain DFT of it padded with zeros to `period` units.
double dft_share_1d(const std::vector<double>& values, double step, double period, double band) {
  double total = 0.0;
  for (double v : values) total += v * v * step;
  double within = 0.0;
  for (int k = 0; k <= int(band * period); ++k) {
    std::complex<double> sum = 0.0;
    for (size_t i = 0; i < values.size(); ++i)
      sum += values[i] * std::polar(step, -2.0 * pi * k / period * step * (double(i) + 0.5));
    within += (k == 0 ? 1.0 : 2.0) * std::norm(sum) / period;
  }
  return within / total;
}

/// The same in two dimensions, of the histogram of a lens profile's samples over [-1.2, 1.2]^2.
double dft_share_2d(const LensProfile& profile, double band) {
  constexpr int cells = 160, grid = 2048, modes = 40;
  constexpr double reach = 1.2, period = 20.0, step = 2.0 * reach / cells;
  std::vector<double> density(cells * cells, 0.0);
  for (int j = 0; j < grid; ++j) {
    for (int i = 0; i < grid; ++i) {
      const glm::vec2 p = profile.sample((float(i) + 0.5f) / grid, (float(j) + 0.5f) / grid);
      const int x = int((double(p.x) + reach) / step), y = int((double(p.y) + reach) / step);
      density[size_t(y * cells + x)] += 1.0;
    }
  }
  double total = 0.0;
  for (double d : density) total += d * d * step * step;
  // Rows first, then columns: separable.
  std::vector<std::complex<double>> wave(size_t(2 * modes + 1) * cells), rows(wave.size());
  for (int k = -modes; k <= modes; ++k)
    for (int i = 0; i < cells; ++i)
      wave[size_t((k + modes) * cells + i)] = std::polar(step, -2.0 * pi * k / period * step * i);
  for (int k = 0; k <= 2 * modes; ++k)
    for (int y = 0; y < cells; ++y)
      for (int x = 0; x < cells; ++x)
        rows[size_t(k * cells + y)] += density[size_t(y * cells + x)] * wave[size_t(k * cells + x)];
  double within = 0.0;
  for (int k = -modes; k <= modes; ++k) {
    for (int l = -modes; l <= modes; ++l) {
      if (std::hypot(k, l) > band * period) continue;
      std::complex<double> sum = 0.0;
      for (int y = 0; y < cells; ++y)
        sum += rows[size_t((k + modes) * cells + y)] * wave[size_t((l + modes) * cells + y)];
      within += std::norm(sum) / (period * period);
    }
  }
  return within / total;
}

}  // namespace

TEST_CASE("shutter samples are distributed as the response") {
  for (const char* name : {"box", "trapezoid", "gaussian"}) {
    const auto profile = make_shutter_profile(name);
    INFO(name);
    // Integral of the response up to each sample is the uniform number it came from.
    constexpr int n = 20000;
    double integral = 0.0;
    float previous = profile->sample(0.0f);
    CHECK(previous == Approx(0.0).margin(1e-6));
    for (int i = 1; i < n; ++i) {
      const float t = profile->sample(float(i) / n);
      REQUIRE(t >= previous);
      REQUIRE(t <= 1.0f);
      const double a = previous, b = t;
      integral +=
          (b - a) / 6.0 *
          (profile->response(a) + 4.0 * profile->response(0.5 * (a + b)) + profile->response(b));
      // Quadrature of the first, steepest steps leaves some 1e-5.
      REQUIRE(integral == Approx(double(i) / n).margin(3e-5));
      previous = t;
    }
    CHECK(profile->sample(0.5f) == Approx(0.5f));
    CHECK(profile->response(-0.01) == 0.0);
    CHECK(profile->response(1.01) == 0.0);
  }
}

TEST_CASE("shutter band limits hold the stated share of the energy") {
  for (const char* name : {"box", "trapezoid", "gaussian"}) {
    const auto profile = make_shutter_profile(name);
    constexpr int n = 1000;
    std::vector<double> response;
    for (int i = 0; i < n; ++i) response.push_back(profile->response((i + 0.5) / n));
    for (double share : {0.5, 0.9, 0.99}) {
      INFO(name << " " << share);
      const double band = profile->band_limit(share);
      // A sum over bins of width 1/64 for an integral: off by half a bin at the end.
      CHECK(dft_share_1d(response, 1.0 / n, 64.0, band) == Approx(share).margin(0.015));
    }
  }
  // Box: the integral of sinc^2 over [-1/2, 1/2] is 2 / pi * (Si(pi) - 2 / pi).
  const double Si_pi = 1.851937051982466;
  CHECK(make_shutter_profile("box")->band_limit(2 / pi * (Si_pi - 2 / pi)) ==
        Approx(0.5).epsilon(1e-5));
  // Gaussian, hardly cut: the power spectrum is a Gaussian of deviation 1 / (2 sqrt(2) pi sigma);
  // 68.27% of it lies within one deviation.
  CHECK(make_shutter_profile("gaussian")->band_limit(0.6826895) ==
        Approx(6.0 / (2.0 * std::sqrt(2.0) * pi)).epsilon(5e-3));
}

TEST_CASE("the band limit of the disc is that of the Airy pattern") {
  const auto disc = make_lens_profile("disc", 6, 0);
  for (double f : {0.3, 0.5, 0.85, 1.9, 9.9}) {
    const double x = 2.0 * pi * f, share = 1.0 - std::pow(::j0(x), 2) - std::pow(::j1(x), 2);
    CHECK(disc->band_limit(share) == Approx(f).epsilon(1e-4));
  }
}

TEST_CASE("lens band limits hold the stated share of the energy of the samples") {
  for (const char* name : {"disc", "smooth", "polygon"}) {
    for (int blades : {3, 6}) {
      if (blades != 6 && std::string(name) != "polygon") continue;
      const auto profile = make_lens_profile(name, blades, 17.0);
      for (double share : {0.5, 0.9}) {
        INFO(name << " " << blades << " " << share);
        // Histogram noise and bins of 1/20 cycle.
        CHECK(dft_share_2d(*profile, profile->band_limit(share)) == Approx(share).margin(0.03));
      }
    }
  }
}

TEST_CASE("a polygon of many blades has the band limit of a disc") {
  const auto disc = make_lens_profile("disc", 0, 0), polygon = make_lens_profile("polygon", 64, 0);
  for (double share : {0.5, 0.8, 0.95, 0.99})
    CHECK(polygon->band_limit(share) == Approx(disc->band_limit(share)).epsilon(0.01));
}

TEST_CASE("band limits refuse shares that no finite band holds") {
  for (double share : {0.0, -0.5, 1.0, std::nan("")}) {
    CHECK_THROWS_AS(make_shutter_profile("box")->band_limit(share), Error);
    CHECK_THROWS_AS(make_lens_profile("disc", 6, 0)->band_limit(share), Error);
    CHECK_THROWS_AS(make_lens_profile("polygon", 6, 0)->band_limit(share), Error);
  }
}

TEST_CASE("lens samples preserve area and stay within the extent") {
  constexpr int n = 512;
  for (const char* name : {"disc", "polygon", "smooth"}) {
    const auto profile = make_lens_profile(name, 5, 30.0);
    INFO(name);
    double reach = 0.0, inside_half = 0.0, in_first_fifth = 0.0;
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        const glm::vec2 p = profile->sample((float(i) + 0.5f) / n, (float(j) + 0.5f) / n);
        reach = std::max<double>(reach, glm::length(p));
        if (glm::length(p) < 0.5f) inside_half += 1.0 / (n * n);
        const double turn = std::fmod(std::atan2(p.y, p.x) / (2 * pi) - 30.0 / 360 + 1.0, 1.0);
        if (turn < 0.2) in_first_fifth += 1.0 / (n * n);
      }
    }
    reach = std::max<double>(reach, glm::length(profile->sample(0.0f, 0.0f)));
    CHECK(reach <= double(profile->extent()));
    CHECK(reach > double(profile->extent()) - 0.01);
    CHECK(in_first_fifth == Approx(0.2).margin(2e-3));
    // Share within half the radius: a quarter of pi over the light in all.
    const std::string kind = name;
    double light = pi;
    if (kind == "polygon") light = 2.5 * std::sin(2 * pi / 5);
    if (kind == "smooth") {
      light = pi * 0.81;
      for (int k = 0; k < 1000; ++k) {
        const double x = (k + 0.5) / 1000, r = 0.9 + 0.2 * x;
        light += (1 - x * x * (3 - 2 * x)) * 2 * pi * r * 0.2 / 1000;
      }
    }
    CHECK(inside_half == Approx(pi / 4 / light).margin(1e-3));
  }
}

TEST_CASE("the edge of the smooth lens falls as the smoothstep") {
  const auto profile = make_lens_profile("smooth", 6, 0);
  constexpr int n = 4000000, bins = 10;
  std::vector<double> light(bins, 0.0);
  for (int i = 0; i < n; ++i) {
    // An irrational lattice, so that no two samples lie on one concentric square.
    const double a = std::fmod(i * 0.7548776662466927, 1.0);
    const double b = std::fmod(i * 0.5698402909980532, 1.0);
    const float r = glm::length(profile->sample(float(a), float(b)));
    const int bin = int((r - 0.9f) / 0.2f * bins);
    if (r >= 0.9f && bin < bins) light[size_t(bin)] += 1.0;
  }
  for (int b = 0; b < bins; ++b) {
    const double x = (b + 0.5) / bins, r = 0.9 + 0.2 * x, x0 = 0.5 / bins;
    const double expected = (1 - x * x * (3 - 2 * x)) * r / ((1 - x0 * x0 * (3 - 2 * x0)) * 0.91);
    CHECK(light[size_t(b)] / light[0] == Approx(expected).margin(0.01));
  }
}

TEST_CASE("lens maps are continuous") {
  constexpr int n = 400;
  for (const char* name : {"disc", "polygon", "smooth"}) {
    const auto profile = make_lens_profile(name, 3, 0.0);
    float widest = 0.0f;
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        const float a = (float(i) + 0.5f) / n, b = (float(j) + 0.5f) / n;
        const glm::vec2 p = profile->sample(a, b);
        widest = std::max(widest, glm::distance(p, profile->sample(a + 1.0f / n, b)));
        widest = std::max(widest, glm::distance(p, profile->sample(a, b + 1.0f / n)));
      }
    }
    INFO(name);
    // A triangle's sides stretch most; the smooth edge by its cube root.
    CHECK(widest < (std::string(name) == "smooth" ? 0.05f : 6.0f / n));
  }
}
