/// How far the edge functions of hide/tct_edges.h put an edge from where it is.

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

#include "hide/tct_edges.h"

using namespace tessera;

namespace {

using Real = long double;

/// A micropolygon of a pixel, far from the raster's origin, that moves 50 pixels and nears the eye,
/// and whose circle of confusion has a radius of about 20 pixels.
struct MovingQuad {
  Quad quad;
  CoverageFrame frame;
  float x, y;  ///< where it is at s = 0, pixels

  explicit MovingQuad(std::mt19937& random) {
    std::uniform_real_distribution<float> unit(-1, 1);
    x = 2000 + 1900 * unit(random), y = 1000 + 900 * unit(random);
    const float angle = 3.15f * unit(random);
    frame.coc_x = {20, 0.5f}, frame.coc_y = {20, 0.5f};
    for (int k = 0; k < 4; ++k) {
      const float at_x = x + float(k % 2) + 0.3f * unit(random);
      const float at_y = y + float(k / 2) + 0.3f * unit(random);
      const float begin = 5 + 0.02f * unit(random), end = 4.5f + 0.02f * unit(random);
      const float dx = 25 * std::cos(angle), dy = 25 * std::sin(angle);
      quad.W[k] = quad.z[k] = begin, quad.dW[k] = quad.dz[k] = end - begin;
      quad.X[k] = (at_x - dx) * begin, quad.dX[k] = (at_x + dx) * end - quad.X[k];
      quad.Y[k] = (at_y - dy) * begin, quad.dY[k] = (at_y + dy) * end - quad.Y[k];
    }
  }
};

struct ExactCorner {
  Real X, Y, W;  ///< at one time and lens position
};

ExactCorner exact_corner(const MovingQuad& m, int k, Real s, Real u, Real v) {
  const auto at = [&](float start, float delta) { return Real(start) + (s + 0.5L) * Real(delta); };
  const Quad& q = m.quad;
  const Real coc = Real(m.frame.coc_x.scale) * at(q.z[k], q.dz[k]) + Real(m.frame.coc_x.offset);
  return {at(q.X[k], q.dX[k]) + u * coc, at(q.Y[k], q.dY[k]) + v * coc, at(q.W[k], q.dW[k])};
}

/// What the SIMD test computes, in float.
float edge_ab(const TimeEdges& edges, float x, float y, float u, float v, float s) {
  const auto term = [&](TimeEdges::Term t) {
    const auto& c = edges.coefficient[0][t];
    return std::fma(std::fma(c[2], s, c[1]), s, c[0]);
  };
  const float constant =
      std::fma(u, term(TimeEdges::Q), std::fma(v, term(TimeEdges::P), term(TimeEdges::K)));
  const float per_y = std::fma(u, term(TimeEdges::T), term(TimeEdges::S));
  const float per_x = std::fma(v, term(TimeEdges::V), term(TimeEdges::U));
  return std::fma(-(x - edges.x_reference), per_x,
                  std::fma(-(y - edges.y_reference), per_y, constant));
}

/// Largest distance in pixels between edge a-b and where its edge function vanishes, over random
/// times and lens positions. The bucket decides where the reference point may be.
Real worst_distance(const PixelRect* bucket) {
  std::mt19937 random(9);
  std::uniform_real_distribution<float> unit(-1, 1);
  Real worst = 0;
  for (int n = 0; n < 20000; ++n) {
    const MovingQuad m(random);
    const int x0 = int(m.x) - 32, y0 = int(m.y) - 32;
    const PixelRect around{x0, y0, x0 + 64, y0 + 64};
    const TimeEdges edges =
        set_up_time_edges(m.quad, m.frame, true, true, bucket ? *bucket : around);
    const float s = 0.5f * unit(random), u = unit(random), v = unit(random);
    const ExactCorner a = exact_corner(m, 0, s, u, v), b = exact_corner(m, 1, s, u, v);
    // A sample within a pixel of the edge.
    const float x = float(a.X / a.W) + unit(random), y = float(a.Y / a.W) + unit(random);
    const Real per_x = -(a.W * b.Y - b.W * a.Y), per_y = -(a.X * b.W - b.X * a.W);
    const Real exact = (a.X - x * a.W) * (b.Y - y * b.W) - (b.X - x * b.W) * (a.Y - y * a.W);
    // All edge functions carry one scale; x at the reference point tells which.
    const ExactCorner a0 = exact_corner(m, 0, 0, 0, 0), b0 = exact_corner(m, 1, 0, 0, 0);
    const Real U =
        a0.W * (b0.Y - edges.y_reference * b0.W) - b0.W * (a0.Y - edges.y_reference * a0.W);
    const Real S =
        (a0.X - edges.x_reference * a0.W) * b0.W - (b0.X - edges.x_reference * b0.W) * a0.W;
    const bool by_x = std::abs(U) > std::abs(S);
    const Real scale =
        Real(edges.coefficient[0][by_x ? TimeEdges::U : TimeEdges::S][0]) / (by_x ? U : S);
    const Real error = std::abs(Real(edge_ab(edges, x, y, u, v, s)) / scale - exact);
    worst = std::max(worst, error / std::hypot(per_x, per_y));
  }
  return worst;
}

}  // namespace

TEST_CASE("Time-dependent edge functions put edges where they are") {
  const Real local = worst_distance(nullptr);
  const PixelRect corner{0, 0, 1, 1};  // the reference point at the raster's origin
  const Real distant = worst_distance(&corner);
  INFO("worst distance " << double(local) << " pixels, " << double(distant)
                         << " with a distant reference point");
  // Terms of about 100 pixels times the length of the edge, rounded a few times.
  REQUIRE(local < 16 * 0x1p-24L * 100);
  REQUIRE(distant > 10 * local);
}
