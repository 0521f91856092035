// Ear clipping against areas, edge balance and inside tests.

#include <cmath>
#include <map>
#include <numeric>
#include <random>

#include <catch2/catch.hpp>

#include "dice/triangulate.h"

namespace tessera::test {
namespace {

using Loops = std::vector<std::vector<int>>;

double area(const std::vector<glm::dvec3>& p, const std::array<int, 3>& t) {
  return 0.5 * glm::cross(p[size_t(t[1])] - p[size_t(t[0])], p[size_t(t[2])] - p[size_t(t[0])]).z;
}

// Triangles tile the polygon: right number, no negative area, the area of the loops, and edges
// that cancel except along the loops.
void check_tiling(const std::vector<glm::dvec3>& p, const Loops& loops, double expected_area) {
  const auto triangles = triangulate(p, loops);
  size_t vertices = 0;
  for (const auto& loop : loops) vertices += loop.size();
  CHECK(triangles.size() == vertices + 2 * (loops.size() - 1) - 2);
  double sum = 0;
  std::map<std::pair<int, int>, int> balance;
  const auto count = [&](int a, int b, int sign) {
    if (a != b) balance[{std::min(a, b), std::max(a, b)}] += a < b ? sign : -sign;
  };
  for (const auto& t : triangles) {
    CHECK(area(p, t) >= -1e-12);
    sum += area(p, t);
    for (size_t e = 0; e < 3; ++e) count(t[e], t[(e + 1) % 3], 1);
  }
  CHECK(sum == Approx(expected_area).epsilon(1e-12));
  for (size_t l = 0; l < loops.size(); ++l) {
    // Holes may be given either way round; triangles leave them on the right.
    std::vector<int> loop = loops[l];
    if (l > 0 && area_vector(p, loop).z > 0) std::reverse(loop.begin(), loop.end());
    for (size_t i = 0; i < loop.size(); ++i) count(loop[i], loop[(i + 1) % loop.size()], -1);
  }
  for (const auto& entry : balance) CHECK(entry.second == 0);
}

std::vector<int> iota(int first, int count) {
  std::vector<int> loop(static_cast<size_t>(count));
  std::iota(loop.begin(), loop.end(), first);
  return loop;
}

TEST_CASE("concave polygons are triangulated", "[dice][triangulate]") {
  // A comb.
  std::vector<glm::dvec3> comb{{0, 0, 0}, {9, 0, 0}};
  for (int k = 8; k >= 0; --k) comb.emplace_back(k + 0.5, k % 2 ? 5 : 1, 0);
  const Loops loops{iota(0, int(comb.size()))};
  check_tiling(comb, loops, 0.5 * area_vector(comb, loops[0]).z);
}

TEST_CASE("collinear and repeated vertices are kept", "[dice][triangulate]") {
  const std::vector<glm::dvec3> p{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 0, 0}, {2, 1, 0},
                                  {2, 2, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}};
  check_tiling(p, {iota(0, 9)}, 4.0);
}

TEST_CASE("holes are left out", "[dice][triangulate]") {
  std::vector<glm::dvec3> p{{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}};
  Loops loops{{0, 1, 2, 3}};
  double expected = 100;
  // A grid of holes, alternately clockwise and not.
  for (int k = 0; k < 9; ++k) {
    const double x = 1 + 3 * (k % 3), y = 1 + 3 * (k / 3);
    const int first = int(p.size());
    p.insert(p.end(), {{x, y, 0}, {x + 2, y, 0}, {x + 2, y + 2, 0}, {x, y + 2, 0}});
    std::vector<int> hole = iota(first, 4);
    if (k % 2) std::reverse(hole.begin(), hole.end());
    loops.push_back(hole);
    expected -= 4;
  }
  check_tiling(p, loops, expected);
}

TEST_CASE("random star polygons are triangulated", "[dice][triangulate]") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> radius(0.2, 2.0);
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<glm::dvec3> p;
    const int n = 3 + trial % 40;
    for (int k = 0; k < n; ++k) {
      const double a = 6.283185307179586 * k / n, r = radius(random);
      p.emplace_back(r * std::cos(a), r * std::sin(a), 0);
    }
    Loops loops{iota(0, n)};
    double expected = 0.5 * area_vector(p, loops[0]).z;
    if (n > 6) {
      // A hole within the innermost radius.
      const int first = int(p.size());
      p.insert(p.end(), {{0.05, 0, 0}, {0, 0.05, 0}, {-0.05, 0, 0}, {0, -0.05, 0}});
      loops.push_back(iota(first, 4));
      expected -= 2 * 0.05 * 0.05;
    }
    check_tiling(p, loops, expected);
  }
}

TEST_CASE("triangulation of nonsense ends", "[dice][triangulate]") {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<glm::dvec3> p;
    for (int k = 0; k < 30; ++k) p.emplace_back(uniform(random), uniform(random), uniform(random));
    CHECK(triangulate(p, {iota(0, 20), iota(20, 10)}).size() == 30);
  }
  const std::vector<glm::dvec3> same(6, glm::dvec3(1, 2, 3));
  CHECK(triangulate(same, {iota(0, 6)}).size() == 4);
  const std::vector<glm::dvec3> nan(5, glm::dvec3(std::nan("")));
  CHECK(triangulate(nan, {iota(0, 5)}).size() == 3);
  CHECK(triangulate(same, {iota(0, 2)}).empty());
}

}  // namespace
}  // namespace tessera::test
