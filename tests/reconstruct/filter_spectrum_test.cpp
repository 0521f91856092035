/// Band limits of the pixel filters against a fast Fourier transform of their weights.

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

#include <glm/glm.hpp>

#include "base/error.h"
#include "reconstruct/pixel_filter.h"
#include "reconstruct/quadrature.h"
#include "tests/cameras/fourier.h"

using namespace tessera;
using namespace tessera::test;

namespace {

constexpr size_t count = 2048;
constexpr double period = 32.0;  ///< 1/64 pixel a point: frequencies up to 32 in steps of 1/32

std::vector<double> axis_power(const PixelFilterDefinition& filter, double width) {
  std::vector<Complex> values(count);
  for (size_t i = 0; i < count; ++i) {
    const double x = (double(i) + 0.5) * period / double(count) - period / 2;
    if (std::abs(x) <= 0.5 * width) values[i] = filter.weight(x, width);
  }
  fourier_transform(values.data(), count);
  std::vector<double> power;
  for (const Complex& v : values) power.push_back(std::norm(v));
  return power;
}

/// Shares of the two-dimensional spectrum within each of `radii`; one quadrant and its mirrors.
std::vector<double> shares_within(const std::vector<double>& x_power,
                                  const std::vector<double>& y_power,
                                  const std::vector<double>& radii) {
  double total = 0.0;
  std::vector<double> inside(radii.size(), 0.0);
  for (size_t j = 0; j < count / 2; ++j) {
    for (size_t i = 0; i < count / 2; ++i) {
      const double mirrors = (i == 0 ? 1.0 : 2.0) * (j == 0 ? 1.0 : 2.0);
      const double energy = mirrors * x_power[i] * y_power[j];
      const double radius = std::hypot(double(i), double(j)) / period;
      total += energy;
      for (size_t k = 0; k < radii.size(); ++k)
        inside[k] += energy * bin_within(radius, radii[k], 1 / period);
    }
  }
  for (double& share : inside) share /= total;
  return inside;
}

/// The transform of a filter's weights along one axis, squared.
double power_at(const PixelFilterDefinition& filter, double width, double frequency) {
  const double half = gauss_integral(0.0, 0.5 * width, 4, [&](double x) {
    return filter.weight(x, width) * std::cos(2.0 * std::numbers::pi * frequency * x);
  });
  return 4.0 * half * half;
}

double axis_energy(const PixelFilterDefinition& filter, double width) {
  return 2.0 * gauss_integral(0.0, 0.5 * width, 4, [&](double x) {
           return filter.weight(x, width) * filter.weight(x, width);
         });
}

/// The share of the two-dimensional spectrum within a radius, summed over frequencies.
double share_within(const PixelFilterDefinition& filter, double x_width, double y_width,
                    double radius) {
  const int panels = 6 + int(2 * radius);
  const double quadrant = gauss_integral(0.0, 0.5 * std::numbers::pi, panels, [&](double angle) {
    const double fx = radius * std::sin(angle), end = radius * std::cos(angle);
    return power_at(filter, x_width, fx) * end * gauss_integral(0.0, end, panels, [&](double fy) {
             return power_at(filter, y_width, fy);
           });
  });
  return 4.0 * quadrant / (axis_energy(filter, x_width) * axis_energy(filter, y_width));
}

}  // namespace

TEST_CASE("band limits of pixel filters are those of the spectra summed over frequencies") {
  for (const auto& filter : pixel_filter_registry()) {
    for (glm::dvec2 width : {glm::dvec2(2, 2), glm::dvec2(3, 1.5)}) {
      for (double share : {0.5, 0.9, 0.98}) {
        const double limit = pixel_filter_band_limit(filter, width.x, width.y, share);
        INFO(filter.name << " " << width.x << " x " << width.y << " " << share << ": " << limit);
        // Overlaps are known at 1024 distances and in 64 directions.
        CHECK(share_within(filter, width.x, width.y, limit) == Approx(share).margin(2e-5));
      }
    }
  }
  // What the shading of a frame takes unless told otherwise.
  CHECK(pixel_filter_band_limit(find_pixel_filter("gaussian"), 2, 2, 0.98) ==
        Approx(0.6450255).epsilon(1e-6));
}

TEST_CASE("band limits of pixel filters hold their shares of the spectra of the weights") {
  for (const auto& filter : pixel_filter_registry()) {
    for (glm::dvec2 width : {glm::dvec2(2, 2), glm::dvec2(3, 1.5), glm::dvec2(4, 4)}) {
      const auto x_power = axis_power(filter, width.x), y_power = axis_power(filter, width.y);
      const std::vector<double> shares{0.8, 0.9, 0.95, 0.99};
      std::vector<double> limits;
      for (double share : shares)
        limits.push_back(pixel_filter_band_limit(filter, width.x, width.y, share));
      CHECK(std::is_sorted(limits.begin(), limits.end()));
      const std::vector<double> found = shares_within(x_power, y_power, limits);
      for (size_t k = 0; k < shares.size(); ++k) {
        INFO(filter.name << " " << width.x << " x " << width.y << " " << shares[k]);
        // Bins of 1/32 cycle where the spectrum falls steeply.
        CHECK(found[k] == Approx(shares[k]).margin(4e-3));
      }
    }
  }
}

TEST_CASE("band limits of pixel filters scale with their widths, whichever axis is which") {
  const auto& gaussian = find_pixel_filter("gaussian");
  const double limit = pixel_filter_band_limit(gaussian, 2, 3, 0.9);
  CHECK(pixel_filter_band_limit(gaussian, 3, 2, 0.9) == Approx(limit));
  CHECK(pixel_filter_band_limit(gaussian, 20, 30, 0.9) == Approx(limit / 10));
}

TEST_CASE("band limits of pixel filters refuse impossible shares and widths") {
  const auto& box = find_pixel_filter("box");
  for (double share : {0.0, -1.0, 1.0, std::nan("")})
    CHECK_THROWS_WITH(pixel_filter_band_limit(box, 1, 1, share), Catch::Contains("energy share"));
  for (double width : {0.0, -1.0, double(INFINITY), std::nan("")}) {
    CHECK_THROWS_WITH(pixel_filter_band_limit(box, width, 1, 0.9), Catch::Contains("width"));
    CHECK_THROWS_WITH(pixel_filter_band_limit(box, 1, width, 0.9), Catch::Contains("width"));
  }
}
