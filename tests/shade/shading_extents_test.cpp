#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <numbers>

#include "shade/shading_extents.h"

using namespace tessera;

namespace {

constexpr double pi = std::numbers::pi;

/// Largest f . e_mu over the union of bands |f . e| <= band within theta of e_mu and the disc, by
/// trying points of the disc (e_mu is x) against directions.
double farthest_by_trial(double r, double band, double theta) {
  constexpr int rings = 40, angles = 200, directions = 60;
  double farthest = 0.0;
  for (int k = 1; k <= rings; ++k) {
    for (int i = 0; i <= angles; ++i) {
      const double radius = r * k / rings, turn = pi / 2 * i / angles;
      const double x = radius * std::cos(turn), y = radius * std::sin(turn);
      if (x <= farthest) break;
      for (int d = -directions; d <= directions; ++d) {
        const double direction = theta * d / directions;
        if (std::abs(x * std::cos(direction) + y * std::sin(direction)) > band) continue;
        farthest = x;
        break;
      }
    }
  }
  return farthest;
}

BlurBounds blur(double speed, double theta, double coc) {
  BlurBounds bounds;
  bounds.min_speed = float(speed), bounds.half_span_radians = float(theta);
  bounds.min_coc = float(coc);
  return bounds;
}

}  // namespace

TEST_CASE("the extent along the motion is that of the hourglass, tried point by point") {
  const BandLimits limits{0.8, 0.45, 0.4};
  for (double coc : {0.0, 1.0, 3.0, 20.0}) {
    const double r = std::min(0.4, coc > 0 ? 0.8 / coc : 1.0);
    for (double theta : {0.0, 0.05, 0.3, 0.7, 1.2, 1.5}) {
      for (double speed : {0.5, 1.2, 2.0, 5.0, 30.0, 400.0}) {
        INFO("coc " << coc << " theta " << theta << " speed " << speed);
        const ShadingExtents extents = shading_extents(blur(speed, theta, coc), limits);
        CHECK(extents.d_perp == Approx(2 * r));
        const double tried = 2 * farthest_by_trial(r, 0.45 / speed, theta);
        CHECK(extents.d_mu >= float(tried) * (1 - 1e-6f));
        // The trial's spacing: a 40th of the radius, a 200th of the quarter turn, a 60th of theta.
        CHECK(extents.d_mu <= tried + 2 * r * (1.0 / 40 + pi / 2 / 200 + theta / 60));
      }
    }
  }
}

TEST_CASE("extents of simple cases are those worked out by hand") {
  const BandLimits limits{0.8, 0.5, 0.5};
  // Nothing blurred: pixel rate.
  CHECK(shading_extents(blur(0, 0, 0), limits).d_mu == 1.0f);
  CHECK(shading_extents(blur(0, 0, 0), limits).d_perp == 1.0f);
  // Straight motion over 10 pixels: ten times fewer along it, all across.
  CHECK(shading_extents(blur(10, 0, 0), limits).d_mu == Approx(0.1));
  CHECK(shading_extents(blur(10, 0, 0), limits).d_perp == 1.0f);
  // Out of focus by 8 pixels: 0.1 cycles per pixel all round.
  CHECK(shading_extents(blur(0, 0, 8), limits).d_mu == Approx(0.2));
  CHECK(shading_extents(blur(0, 0, 8), limits).d_perp == Approx(0.2));
  // Motion that is slower than a pixel, or that spreads over half a turn, saves nothing.
  CHECK(shading_extents(blur(0.9, 0, 0), limits).d_mu == 1.0f);
  CHECK(shading_extents(blur(100, pi / 2, 0), limits).d_mu == 1.0f);
  // alpha = acos(0.05 / 0.5): 2 * 0.5 * cos(0.2 - alpha).
  CHECK(shading_extents(blur(10, 0.2, 0), limits).d_mu == Approx(std::cos(0.2 - std::acos(0.1))));
  const ShadingExtents turned = shading_extents({10, {0.6f, 0.8f}, 0, 0}, limits);
  CHECK(turned.direction == glm::vec2(0.6f, 0.8f));
}

TEST_CASE("extents are positive, finite and never above twice the pixel's limit") {
  const float largest = std::numeric_limits<float>::max();
  const float values[] = {0.0f,   std::numeric_limits<float>::denorm_min(),
                          1e-30f, 1e-6f,
                          0.3f,   1.0f,
                          17.0f,  1e7f,
                          1e30f,  largest};
  for (double pixel : {0.5, 0.3, 0.1, 1e-8}) {
    for (float speed : values) {
      for (float coc : values) {
        for (double theta : {0.0, 1e-9, 0.8, pi / 2, 3.2}) {
          const BandLimits limits{0.7, 0.45, pixel};
          const ShadingExtents extents = shading_extents(blur(speed, theta, coc), limits);
          REQUIRE(extents.d_mu > 0.0f);
          REQUIRE(extents.d_mu <= extents.d_perp);
          REQUIRE(extents.d_perp <= float(2 * pixel));
          REQUIRE(std::isfinite(1.0f / extents.d_mu));
          if (pixel > 1e-6) REQUIRE(1.0 / extents.d_mu <= widest_cell_pixels);
        }
      }
    }
  }
}

TEST_CASE("more blur never asks for a denser sampling, more spread never for a sparser one") {
  const BandLimits limits{0.7, 0.45, 0.4};
  for (double theta = 0.0; theta < 1.55; theta += 0.1) {
    for (double speed = 0.1; speed < 100.0; speed *= 1.5) {
      for (double coc : {0.0, 2.0, 5.0}) {
        const float d_mu = shading_extents(blur(speed, theta, coc), limits).d_mu;
        CHECK(shading_extents(blur(1.5 * speed, theta, coc), limits).d_mu <= d_mu);
        CHECK(shading_extents(blur(speed, theta, 1.5 * coc), limits).d_mu <= d_mu);
        CHECK(shading_extents(blur(speed, theta + 0.1, coc), limits).d_mu >= d_mu);
      }
    }
  }
}
