#include <catch2/catch.hpp>

#include <cmath>
#include <random>

#include "shade/noise.h"
#include "tests/shade/fixtures.h"

using namespace tessera;
using namespace tessera::test;

TEST_CASE("the filtered square wave is the integral of the wave") {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> position(-5.0, 5.0), size(0.01, 6.0);
  for (int k = 0; k < 200; ++k) {
    const double x = position(random), width = size(random);
    const int steps = 20000;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
      const double at = x + width * ((i + 0.5) / steps - 0.5);
      sum += (at - 2.0 * std::floor(at / 2.0)) < 1.0 ? 1.0 : -1.0;
    }
    // The midpoint rule misplaces each of the few jumps by at most one step.
    CHECK(filtered_square_wave(float(x), float(width)) == Approx(sum / steps).margin(8.0 / steps));
  }
}

TEST_CASE("the checkerboard averages to grey under a wide filter and is crisp without one") {
  CHECK(filtered_checker({0.5f, 0.5f}, {0, 0}) == 1.0f);
  CHECK(filtered_checker({1.5f, 0.5f}, {0, 0}) == 0.0f);
  CHECK(filtered_checker({-0.5f, 0.5f}, {0, 0}) == 0.0f);
  CHECK(filtered_checker({0.3f, 0.7f}, {1e4f, 1e4f}) == Approx(0.5).margin(1e-6));
  CHECK(filtered_checker({1.0f, 0.5f}, {0.5f, 0.5f}) == Approx(0.5));  // on the edge between two
}

TEST_CASE("the checker shader equals a box over its shading cell") {
  TestScene test;
  test.add_light(call("ambientlight"));
  const Surface& surface = test.add_surface(
      "checker",
      {number("frequency", 3.0f), triple("blackcolor", ValueType::color, {0.25f, 0, 0})});
  const auto grid = make_square(surface, 8, 2.0f);
  const auto bindings = test.bind();
  const SurfaceColors colors = run_surface(*bindings, *grid);
  for (int j = 1; j < 8; ++j) {
    for (int i = 1; i < 8; ++i) {
      const int steps = 400;
      double white = 0.0;
      for (int b = 0; b < steps; ++b) {
        for (int a = 0; a < steps; ++a) {
          const double s = 3.0 * (i + (a + 0.5) / steps - 0.5) / 8.0;
          const double t = 3.0 * (j + (b + 0.5) / steps - 0.5) / 8.0;
          white += (long(std::floor(s)) + long(std::floor(t))) % 2 == 0 ? 1.0 : 0.0;
        }
      }
      white /= double(steps) * steps;
      const glm::vec3 color = colors.Ci[j * 9 + i];
      CHECK(color.x == Approx(0.25 + 0.75 * white).margin(5e-3));
      CHECK(color.y == Approx(white).margin(5e-3));
    }
  }
}

TEST_CASE("gradient noise is zero on the lattice, bounded, continuous and unbiased") {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> place(-50.0f, 50.0f);
  double sum = 0.0, absolute = 0.0;
  float low = 0.0f, high = 0.0f, steepest = 0.0f;
  const int count = 200000;
  for (int k = 0; k < count; ++k) {
    const glm::vec3 p(place(random), place(random), place(random));
    const float n = gradient_noise(p);
    const float step = gradient_noise(p + glm::vec3(1e-3f, 0, 0)) - n;
    steepest = std::max(steepest, std::abs(step) / 1e-3f);
    low = std::min(low, n), high = std::max(high, n);
    sum += n, absolute += std::abs(n);
  }
  CHECK(low >= -1.0f);
  CHECK(high <= 1.0f);
  CHECK(high - low > 1.2f);
  CHECK(steepest < 4.0f);  // a jump between lattice cells would be far steeper
  CHECK(std::abs(sum / count) < 3e-3);
  CHECK(turbulence({0.3f, 0.4f, 0.5f}, 10.0f, 1) == Approx(absolute / count).epsilon(0.02));
  for (int k = -3; k <= 3; ++k) CHECK(gradient_noise(glm::vec3(k, 2 * k, -k)) == 0.0f);
  CHECK(gradient_noise({1e30f, 0.5f, 0.5f}) == 0.0f);
  CHECK(gradient_noise({std::nanf(""), 0.5f, 0.5f}) == 0.0f);
}

TEST_CASE("noise fades to its mean as the shading cell grows") {
  const glm::vec3 p(3.3f, 1.7f, 0.4f);
  CHECK(fractal_noise(p, 0.0f, 4) != 0.0f);
  CHECK(fractal_noise(p, 1.0f, 4) == 0.0f);
  CHECK(fractal_noise(p, 0.2f, 1) == fractal_noise(p, 0.0f, 1));
  // A cell of 0.2 holds the first octave but not the third.
  CHECK(fractal_noise(p, 0.2f, 4) == fractal_noise(p, 0.2f, 2));
  CHECK(turbulence(p, 5.0f, 5) == Approx(turbulence({9.1f, 0.2f, 7.7f}, 5.0f, 5)));
}

TEST_CASE("marble seen from far away has one colour") {
  TestScene test;
  test.add_light(call("ambientlight"));
  const auto near_grid = make_square(test.add_surface("marble"), 64, 4.0f);
  const auto far_grid = make_grid(test.scene.surfaces[0], 16, 16, [](float u, float v) {
    return glm::vec3(400.0f * u, 400.0f * v, 900.0f);
  });
  const auto bindings = test.bind();
  const auto range = [&](const Grid& grid) {
    const SurfaceColors colors = run_surface(*bindings, grid);
    float low = 1e9f, high = -1e9f;
    for (int i = 0; i < grid.vertex_count(); ++i) {
      low = std::min(low, colors.Ci[i].x), high = std::max(high, colors.Ci[i].x);
    }
    return high - low;
  };
  CHECK(range(*near_grid) > 0.3f);
  CHECK(range(*far_grid) < 1e-4f);
}
