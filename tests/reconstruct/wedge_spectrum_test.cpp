/// Fits of the double wedge, and the methods' filters in frequency space.

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

#include "reconstruct/maaf_components.h"
#include "reconstruct/wedge_spectrum.h"
#include "tests/reconstruct/flatland.h"

using namespace tessera;

namespace {

double gaussian(double x, double deviation) {
  return std::exp(-0.5 * x * x / (deviation * deviation));
}

/// Coverage and accuracy of a function over a grid of midpoints that holds all of it.
WedgeFit grid_fit(const DoubleWedge& wedge, const std::vector<SpectrumGaussian>& filter) {
  // Odd sizes: no point lies on the wedge's rim.
  constexpr int steps = 700;
  const double x_reach = 6.8371 / wedge.s_min, y_reach = 7.0;
  double inside = 0, whole = 0, squares = 0, area = 0;
  for (int i = 0; i < steps; ++i) {
    for (int j = 0; j < steps; ++j) {
      const double x = ((i + 0.5) / steps * 2 - 1) * x_reach;
      const double y = ((j + 0.5) / steps * 2 - 1) * y_reach;
      double value = 0;
      for (const SpectrumGaussian& g : filter)
        value += g.weight * gaussian(y - g.y, g.y_deviation) *
                 gaussian(x - g.x - g.shear * (y - g.y), g.x_deviation);
      whole += value;
      const double s = x == 0 ? 0 : y / x;
      if (std::abs(y) > 1 || s < wedge.s_min || s > wedge.s_max) continue;
      inside += value;
      squares += (value - 1) * (value - 1);
      area += 1;
    }
  }
  return {inside / whole, 1 - std::sqrt(squares / area)};
}

/// Sum over dx of weight(dx) cos or sin(frequency dx).
double cosine_transform(const float* weights, int reach, double frequency) {
  double sum = 0;
  for (int dx = -reach; dx <= reach; ++dx) sum += weights[reach + dx] * std::cos(frequency * dx);
  return sum;
}
double sine_transform(const float* weights, int reach, double frequency) {
  double sum = 0;
  for (int dx = -reach; dx <= reach; ++dx) sum += weights[reach + dx] * std::sin(frequency * dx);
  return sum;
}

}  // namespace

TEST_CASE("fits by quadrature are those on a grid", "[wedge]") {
  for (const DoubleWedge& wedge : {DoubleWedge{0.5, 0.8}, {0.7, 2.2}}) {
    for (const auto& filter : {aaf_spectrum(wedge), fsf_spectrum(wedge), maaf_spectrum(wedge, 5)}) {
      const WedgeFit ours = gaussian_fit(wedge, filter), grid = grid_fit(wedge, filter);
      CHECK(ours.coverage == Approx(grid.coverage).epsilon(0.02));
      CHECK(ours.accuracy == Approx(grid.accuracy).epsilon(0.01));
    }
  }
}

TEST_CASE("coverage of boxes has closed forms", "[wedge]") {
  for (const DoubleWedge& wedge : {DoubleWedge{0.5, 0.8}, {1.5, 2.0}, {0.7, 2.2}, {0.01, 9.9}}) {
    const double r = wedge.s_min / wedge.s_max;
    // The box of one component is 2 by 2 / s_min around a wedge of area (1 - r) / s_min.
    CHECK(box_coverage(wedge, 1) == Approx((1 - r) / 4));
    // Equation 18 with 1 / s_min where it prints 1 / s_min^2; s_avg is the harmonic mean.
    const double width = 1 / wedge.s_min - 1 / wedge.s_max;
    const double mean = 0.5 * (1 / wedge.s_min + 1 / wedge.s_max);
    for (int n : {1, 2, 3, 4, 13, 63}) {
      const double inverse = n * (n - 1.0) + (1 / wedge.s_min + 2 * (n - 1) * mean) / width;
      CHECK(box_coverage(wedge, 2 * n - 1) == Approx((n - 0.5) * (n - 0.5) / inverse));
    }
  }
}

TEST_CASE("fits do not depend on the scale of slopes, nor those of FSF on the wedge", "[wedge]") {
  for (int components : {3, 7}) {
    const WedgeFit a = gaussian_fit({0.5, 0.8}, maaf_spectrum({0.5, 0.8}, components));
    const WedgeFit b = gaussian_fit({5, 8}, maaf_spectrum({5, 8}, components));
    CHECK(a.coverage == Approx(b.coverage));
    CHECK(a.accuracy == Approx(b.accuracy));
  }
  const WedgeFit a = gaussian_fit({0.5, 0.8}, fsf_spectrum({0.5, 0.8}));
  const WedgeFit b = gaussian_fit({0.1, 7}, fsf_spectrum({0.1, 7}));
  CHECK(a.coverage == Approx(b.coverage));
  CHECK(a.accuracy == Approx(b.accuracy));
}

TEST_CASE("the sheared filter ends where the wedge does", "[wedge]") {
  const auto filter = fsf_spectrum({0.7, 2.2});
  REQUIRE(filter.size() == 1);
  CHECK(filter[0].shear + filter[0].x_deviation == Approx(1 / 0.7));
  CHECK(filter[0].shear - filter[0].x_deviation == Approx(1 / 2.2));
}

TEST_CASE("fsf's kernel is a Gaussian sheared along the wedge", "[wedge][method]") {
  const auto method = flatland::make_method("fsf");
  const int reach = method->reach(), row = 2 * reach + 1, count = method->basis_count();
  std::vector<float> weights(size_t(count * row)), basis(static_cast<size_t>(count));
  for (const auto& [low, high] : {std::pair{4.0f, 8.0f}, {-10.0f, -5.0f}}) {
    method->weights({low, high}, 1, weights.data());
    const auto kernel = [&](int dx, float y) {
      BasisPoint at;
      at.y = y;
      method->basis(at, basis.data());
      double sum = 0;
      for (int k = 0; k < count; ++k)
        sum += weights[size_t(k * row + reach + dx)] * basis[size_t(k)];
      return sum;
    };
    // Upright, the wedge is 4 |1 / low - 1 / high| wide, and the Gaussian's deviation half that.
    const double along_x = 1 / (2 * std::abs(1.0 / low - 1.0 / high));
    const double shear = 0.5 * (1.0 / low + 1.0 / high);
    for (int dx : {-5, -1, 0, 2, 6}) {
      for (float y : {-0.9f, -0.2f, 0.0f, 0.4f, 1.0f}) {
        INFO(low << " " << high << " dx " << dx << " y " << y);
        CHECK(kernel(dx, y) / kernel(0, 0) ==
              Approx(gaussian(dx, along_x) * gaussian(y + dx * shear, 1.0)).margin(1e-4));
      }
    }
  }
}

TEST_CASE("more components fit the wedge better", "[wedge]") {
  const DoubleWedge wedge{0.7, 2.2};
  WedgeFit last = gaussian_fit(wedge, aaf_spectrum(wedge));
  for (int components : {3, 5, 7}) {
    const WedgeFit fit = gaussian_fit(wedge, maaf_spectrum(wedge, components));
    CHECK(fit.coverage > last.coverage);
    CHECK(fit.accuracy > last.accuracy);
    last = fit;
  }
}

TEST_CASE("aaf's kernel transforms to the Gaussian of the wedge", "[wedge][method]") {
  const auto method = flatland::make_method("aaf");
  const int reach = method->reach();
  std::vector<float> weights(size_t(2 * reach + 1));
  for (float shift : {3.0f, 6.0f, 12.0f, 20.0f}) {
    method->weights({shift, 3 * shift}, 1, weights.data());
    for (double frequency : {0.0, 0.1, 0.3, 0.6, 1.2}) {
      INFO(shift << " " << frequency);
      // Sampled at whole pixels and cut at the reach.
      CHECK(cosine_transform(weights.data(), reach, frequency) ==
            Approx(gaussian(frequency, 4.0 / shift)).margin(6e-3));
    }
  }
}

TEST_CASE("maaf's kernels transform to pairs of Gaussians about the components' centres",
          "[wedge][method]") {
  for (const char* arguments : {"3", "5", "7"}) {
    const auto method = flatland::make_method("maaf", arguments);
    const int reach = method->reach(), row = 2 * reach + 1, m = method->basis_count();
    std::vector<float> weights(size_t(m * row));
    for (const auto& [low, high] : {std::pair{5.0f, 8.0f}, {-10.0f, -4.0f}}) {
      method->weights({low, high}, 1, weights.data());
      const double s_min = std::min(std::abs(low), std::abs(high));
      const double s_max = std::max(std::abs(low), std::abs(high)), sign = low > 0 ? 1 : -1;
      // All share one factor; the central component tells it.
      const double scale = cosine_transform(weights.data(), reach, 0.0);
      for (int p = 1; 2 * p < m; ++p) {
        const double light = std::sin(8.0 * p / m) / (8.0 * p / m);
        const double begin = 4.0 * (2 * p - 1) / m / s_max, end = 4.0 * (2 * p + 1) / m / s_min;
        const double centre = (begin + end) / 2, deviation = (end - begin) / 2;
        for (double frequency : {0.0, 0.2, 0.5, 1.0}) {
          INFO(arguments << " " << low << " p " << p << " frequency " << frequency);
          const double above = gaussian(frequency - centre, deviation);
          const double below = gaussian(frequency + centre, deviation);
          // A cosine is half the sum of the two; a sine half the difference. What the reach cuts
          // off and replicas of the spectrum stay below the margin.
          CHECK(cosine_transform(&weights[size_t((2 * p - 1) * row)], reach, frequency) / scale ==
                Approx(light * (above + below)).margin(0.03));
          CHECK(sine_transform(&weights[size_t(2 * p * row)], reach, frequency) / scale ==
                Approx(-sign * light * (above - below)).margin(0.03));
        }
      }
    }
  }
}

TEST_CASE("maaf's functions of y are its windows, with the second effect's in them",
          "[wedge][method]") {
  const auto method = flatland::make_method("maaf");
  float values[5];
  BasisPoint at;
  at.y = 0.6f;
  at.second_y = 0.3f;
  at.wedge = {5, 8};
  at.second_wedge = {1, 2};
  method->basis(at, values);
  for (int p = 0; p < 3; ++p) {
    // Frequencies along x of the first wedge at y frequencies 4 (2 p -+ 1) / 5; the second effect's
    // are those times its slopes.
    const double begin = p ? 4.0 * (2 * p - 1) / 5 / 8.0 * 1.0 : 0;
    const double end = 4.0 * (2 * p + 1) / 5 / 5.0 * 2.0;
    const double centre = p ? (begin + end) / 2 : 0, deviation = p ? (end - begin) / 2 : end;
    // Over u the Gaussian has mean 1, and the component the weight of even light at its centre.
    double mean = 0;
    for (int i = 0; i < 1000; ++i)
      mean += std::exp(-0.5 * std::pow(((i + 0.5) / 500 - 1) * deviation, 2)) / 1000;
    const double light = p ? std::sin(centre) / centre : 1.0;
    const double window = std::exp(-0.5 * std::pow(0.6 * 4.0 / 5, 2)) * light *
                          std::exp(-0.5 * std::pow(0.3 * deviation, 2)) / mean;
    const double phase = 0.6 * 4.0 * 2 * p / 5 + 0.3 * centre;
    CHECK(values[p ? 2 * p - 1 : 0] == Approx(window * std::cos(phase)).epsilon(1e-5));
    if (p) CHECK(values[2 * p] == Approx(window * std::sin(phase)).epsilon(1e-5));
  }
  // Turning both effects round, and with them y and u, changes nothing but the sign of sines of the
  // turned y: phases run along y.
  float turned[5];
  at.second_wedge = {-2, -1};
  at.second_y = -0.3f;
  method->basis(at, turned);
  for (int k = 0; k < 5; ++k) CHECK(turned[k] == values[k]);
}
