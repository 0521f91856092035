// The search for points in shading space against a look at every triangle, in long double.

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "shade/space_index.h"

using namespace tessera;

namespace {

using Real = long double;
using Real2 = glm::vec<2, long double>;

/// Vertices at place(i, j), with W that varies.
SpaceVertices vertices(int u_count, int v_count, const std::function<glm::vec2(int, int)>& place) {
  SpaceVertices result;
  result.u_count = u_count, result.v_count = v_count;
  for (int j = 0; j <= v_count; ++j)
    for (int i = 0; i <= u_count; ++i) {
      const glm::vec2 at = place(i, j);
      result.x.push_back(at.x), result.y.push_back(at.y);
      result.w.push_back(1.0f + 0.3f * float((i + 2 * j) % 3));
    }
  return result;
}

std::array<size_t, 3> corners(const SpaceVertices& s, uint32_t triangle) {
  const size_t m = triangle / 2, row = size_t(s.u_count) + 1;
  const size_t a = m / size_t(s.u_count) * row + m % size_t(s.u_count);
  return triangle % 2 == 0 ? std::array{a, a + 1, a + row + 1}
                           : std::array{a, a + row + 1, a + row};
}

Real2 place(const SpaceVertices& s, size_t vertex) { return {s.x[vertex], s.y[vertex]}; }

Real distance_to_segment(const Real2& p, const Real2& a, const Real2& b) {
  const Real2 d = b - a;
  const Real length2 = glm::dot(d, d);
  const Real t = length2 > 0 ? std::clamp(glm::dot(p - a, d) / length2, Real(0), Real(1)) : Real(0);
  return glm::length(a + t * d - p);
}

/// To the nearest point of a triangle that is known not to cover p.
Real distance_to(const SpaceVertices& s, uint32_t triangle, const Real2& p) {
  const auto c = corners(s, triangle);
  Real least = std::numeric_limits<Real>::infinity();
  for (size_t k = 0; k < 3; ++k)
    least = std::min(least, distance_to_segment(p, place(s, c[k]), place(s, c[(k + 1) % 3])));
  return least;
}

/// Where a point of the surface lies in the plane, which interpolates Vertex / W.
Real2 place_of(const SpaceVertices& s, const SurfacePoint& point) {
  const auto c = corners(s, point.triangle);
  const Real weights[] = {1 - Real(point.b1) - Real(point.b2), point.b1, point.b2};
  Real2 sum(0);
  Real whole = 0;
  for (size_t k = 0; k < 3; ++k) {
    const Real weight = weights[k] * Real(s.w[c[k]]);
    sum += weight * place(s, c[k]), whole += weight;
  }
  return sum / whole;
}

/// Asks for the point of `chart` nearest to (x, y), which none of its triangles covers.
void check_nearest(const SpaceVertices& s, const SpaceCharts& charts, uint32_t chart, float x,
                   float y) {
  const SpaceIndex index(s, charts);
  Real least = std::numeric_limits<Real>::infinity();
  for (uint32_t triangle = 0; triangle < uint32_t(s.triangle_count()); ++triangle)
    if (charts.of(triangle) == chart) least = std::min(least, distance_to(s, triangle, {x, y}));
  CAPTURE(chart, x, y);
  const SurfacePoint found = index.nearest(chart, x, y, 0.5f);
  CHECK(charts.of(found.triangle) == chart);
  CHECK(double(glm::length(place_of(s, found) - Real2(x, y))) ==
        Approx(double(least)).epsilon(1e-5));
}

}  // namespace

TEST_CASE("of a sheet with nothing near a place the nearest point of all is found") {
  // Three quarters of a narrow ring. The places are so far from it that no bin around them has any
  // of it: a bin may hold what is near it, though not the nearest, and that will do.
  const SpaceVertices ring = vertices(40, 1, [](int i, int j) {
    const float angle = 4.7f * float(i) / 40.0f, radius = 20.0f + float(j);
    return radius * glm::vec2(std::cos(angle), std::sin(angle));
  });
  const SpaceCharts one;  // all of it is one sheet
  for (const glm::vec2 at : {glm::vec2(0, 1), {3, -7}, {0.5f, 13}, {15, -15}, {-2, -11}})
    check_nearest(ring, one, 0, at.x, at.y);
}

TEST_CASE("what other sheets have near a place does not count") {
  // A strip that runs to the right and folds back over its last tenth.
  const float columns[] = {0, 10, 20, 19, 18};
  const SpaceVertices fold =
      vertices(4, 2, [&](int i, int j) { return glm::vec2(columns[i], 10.0f * float(j)); });
  const SpaceCharts charts(fold);
  const uint32_t front = charts.of(0), back = charts.of(4);
  REQUIRE(front != back);
  for (const glm::vec2 at : {glm::vec2(2, 5), {9, 19}, {12, 0.5f}, {0, 10}})
    check_nearest(fold, charts, back, at.x, at.y);
}
