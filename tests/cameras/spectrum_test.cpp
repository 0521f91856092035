/// Band limits of the profiles against a fast Fourier transform of the shapes themselves, at the
/// shares that shading rates are chosen by.

#include <catch2/catch.hpp>

#include <string>

#include "base/error.h"
#include "cameras/lens_profile.h"
#include "cameras/shutter_profile.h"
#include "cameras/spectrum.h"
#include "tests/cameras/fourier.h"

using namespace tessera;
using namespace tessera::test;

namespace {

constexpr double pi = std::numbers::pi;
constexpr double shares[] = {0.8, 0.9, 0.95, 0.98, 0.99};

double disc_light(double u, double v) { return std::hypot(u, v) <= 1.0 ? 1.0 : 0.0; }

double smooth_light(double u, double v) {
  const double x = std::clamp((std::hypot(u, v) - 0.9) / 0.2, 0.0, 1.0);
  return 1.0 - x * x * (3.0 - 2.0 * x);
}

/// Within all sides of the regular polygon in the unit circle that has a corner at `turn` radians.
double polygon_light(double u, double v, int blades, double turn) {
  for (int i = 0; i < blades; ++i) {
    const double normal = turn + 2.0 * pi * (i + 0.5) / blades;
    if (u * std::cos(normal) + v * std::sin(normal) > std::cos(pi / blades)) return 0.0;
  }
  return 1.0;
}

/// Points of 1/64 unit over 16: frequencies up to 32 in steps of 1/16. Energy beyond is folded
/// back: a few thousandths of a shape with sharp edges, spread evenly, of which less than a tenth
/// comes within the radii asked for here.
PowerSpectrum spectrum_of(const std::function<double(double, double)>& light) {
  constexpr size_t count = 1024;
  constexpr double period = 16.0;
  std::vector<Complex> values(count * count);
  const auto place = [&](size_t i) { return (double(i) + 0.5) * period / count - period / 2; };
  for (size_t j = 0; j < count; ++j) {
    for (size_t i = 0; i < count; ++i) {
      const double u = place(i), v = place(j);
      if (std::hypot(u, v) < 1.2) values[j * count + i] = light(u, v);
    }
  }
  return PowerSpectrum(count, period, std::move(values));
}

void check_lens(const LensProfile& profile, const std::function<double(double, double)>& light) {
  const PowerSpectrum spectrum = spectrum_of(light);
  double previous = 0.0;
  for (double share : shares) {
    INFO(profile.name() << " " << share);
    const double limit = profile.band_limit(share);
    CHECK(limit > previous);
    previous = limit;
    // Bins of 1/16 where the spectrum falls steeply (at the smallest shares), and folded energy.
    CHECK(spectrum.share_of_disc(limit) == Approx(share).margin(2.5e-3));
  }
}

}  // namespace

TEST_CASE("lens band limits hold their shares of the spectra of the shapes") {
  check_lens(*make_lens_profile("disc", 6, 0), disc_light);
  check_lens(*make_lens_profile("smooth", 6, 0), smooth_light);
  for (int blades : {5, 6})
    check_lens(*make_lens_profile("polygon", blades, 17.0),
               [=](double u, double v) { return polygon_light(u, v, blades, 17.0 * pi / 180.0); });
}

TEST_CASE("shutter band limits hold their shares of the spectra of the responses") {
  // 1024 midpoints of the shutter over a period of 64: frequencies up to 512 in steps of 1/64.
  constexpr size_t count = 65536, points = 1024;
  constexpr double period = 64.0;
  for (const char* name : {"box", "trapezoid", "gaussian"}) {
    const auto profile = make_shutter_profile(name);
    std::vector<Complex> values(count);
    for (size_t i = 0; i < points; ++i) values[i] = profile->response((double(i) + 0.5) / points);
    fourier_transform(values.data(), count);
    for (double share : shares) {
      INFO(name << " " << share);
      const double limit = profile->band_limit(share);
      double total = 0.0, within = 0.0;
      for (size_t k = 0; k < count; ++k) {
        const double power = std::norm(values[k]), f = std::abs(bin_frequency(k, count, period));
        total += power, within += power * bin_within(f, limit, 1.0 / period);
      }
      CHECK(within / total == Approx(share).margin(2e-4));
    }
  }
}

TEST_CASE("the radius of a Gaussian of two dimensions is that of its closed form") {
  // exp(-p^2 / 2) overlaps its copy at distance s by pi exp(-s^2 / 4); its power spectrum is
  // a Gaussian, of which 1 - exp(-4 pi^2 f^2) lies within f.
  constexpr double reach = 14.0;
  std::vector<double> overlap;
  for (int i = 0; i <= 512; ++i) {
    const double s = reach * i / 512;
    overlap.push_back(pi * std::exp(-s * s / 4.0));
  }
  for (double share : {0.1, 0.5, 0.9, 0.99, 0.9999}) {
    const double radius = radius_holding(share, overlap, reach);
    // Slopes of the overlap are taken to be constant over 1/36 of a deviation.
    CHECK(1.0 - std::exp(-4.0 * pi * pi * radius * radius) == Approx(share).margin(5e-5));
  }
  for (double share : {0.0, 1.0, std::nan("")})
    CHECK_THROWS_AS(radius_holding(share, overlap, reach), Error);
}
