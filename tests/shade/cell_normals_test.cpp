/// Mean, change and scatter of the normals within a cell, against sums over a dense raster of it.

#include <catch2/catch.hpp>

#include <cmath>

#include "shade/cell_normals.h"
#include "tests/shade/fixtures.h"

using namespace tessera;
using namespace tessera::test;

namespace {

constexpr int count = 32;

/// A square whose unit normals are those of slopes (p, q) at vertex (i, j).
std::shared_ptr<Grid> grid_with_slopes(const Surface& surface,
                                       const std::function<glm::vec2(float i, float j)>& slopes) {
  auto grid = make_square(surface, count, 3.0f);
  const size_t stride = grid->stride();
  for (int j = 0; j <= count; ++j) {
    for (int i = 0; i <= count; ++i) {
      const glm::vec2 s = slopes(float(i), float(j));
      const glm::vec3 N = glm::normalize(glm::vec3(-s.x, -s.y, -1.0f));
      for (int axis = 0; axis < 3; ++axis)
        grid->N_camera[size_t(axis) * stride + size_t(j * (count + 1) + i)] = N[axis];
    }
  }
  return grid;
}

/// A cell around the middle of micropolygon (16, 16).
CellPoint cell_of(const Grid& grid, glm::vec2 x, glm::vec2 y) {
  CellPoint cell;
  cell.grid = &grid;
  cell.at = {uint32_t(2 * (16 * count + 16)), 0.0f, 0.5f};
  cell.footprint = {x, y};
  return cell;
}

struct Moments {
  glm::dvec3 mean{0}, per_x{0}, per_y{0};
  double variance = 0;
};

/// By 200 x 200 points of the cell, each with the normal of the slopes there.
Moments brute_force(const CellPoint& cell,
                    const std::function<glm::vec2(float i, float j)>& slopes) {
  constexpr int n = 200;
  Moments m;
  double squares = 0;
  for (int b = 0; b < n; ++b) {
    for (int a = 0; a < n; ++a) {
      const float at_x = (float(a) + 0.5f) / n - 0.5f, at_y = (float(b) + 0.5f) / n - 0.5f;
      const glm::vec2 ij =
          glm::vec2(16.5f) + at_x * cell.footprint.ij_per_x + at_y * cell.footprint.ij_per_y;
      const glm::vec2 s = slopes(ij.x, ij.y);
      const glm::dvec3 N = glm::normalize(glm::dvec3(-s.x, -s.y, -1.0));
      m.mean += N, m.per_x += 12.0 * double(at_x) * N, m.per_y += 12.0 * double(at_y) * N;
      squares += glm::dot(N, N);
    }
  }
  const double points = double(n) * n;
  m.mean /= points, m.per_x /= points, m.per_y /= points;
  m.variance = squares / points - glm::dot(m.mean, m.mean) -
               (glm::dot(m.per_x, m.per_x) + glm::dot(m.per_y, m.per_y)) / 12;
  return m;
}

void check_against(const Moments& m, const CellNormal& found, double tolerance) {
  CHECK(glm::length(glm::dvec3(found.N) - glm::normalize(m.mean)) < tolerance);
  CHECK(glm::length(glm::dvec3(found.dNdx) - m.per_x) < 2 * tolerance);
  CHECK(glm::length(glm::dvec3(found.dNdy) - m.per_y) < 2 * tolerance);
  CHECK(double(found.variance) == Approx(m.variance).margin(tolerance));
}

}  // namespace

TEST_CASE("a flat cell has one normal, of no variance") {
  TestScene test;
  const auto grid = grid_with_slopes(test.add_surface("matte"),
                                     [](float, float) { return glm::vec2(0.3f, -0.1f); });
  for (const float size : {0.5f, 5.0f, 30.0f}) {
    const CellNormal found = cell_normal(cell_of(*grid, {size, 0}, {0, size}));
    CHECK(glm::length(found.N - glm::normalize(glm::vec3(-0.3f, 0.1f, -1.0f))) < 1e-6f);
    CHECK(glm::length(found.dNdx) < 1e-5f);
    CHECK(glm::length(found.dNdy) < 1e-5f);
    CHECK(found.variance < 1e-5f);
  }
}

TEST_CASE("a curved cell has the change of its normals, and next to no scatter") {
  TestScene test;
  const auto slopes = [](float i, float j) {
    return glm::vec2(0.02f * (i - 16.5f), 0.01f * (j - 16.5f));
  };
  const auto grid = grid_with_slopes(test.add_surface("matte"), slopes);
  for (const auto& [x, y] :
       {std::pair{glm::vec2(8, 0), glm::vec2(0, 8)}, std::pair{glm::vec2(6, 6), glm::vec2(-1, 1)},
        std::pair{glm::vec2(12, 2), glm::vec2(0, 3)}}) {
    const CellPoint cell = cell_of(*grid, x, y);
    const CellNormal found = cell_normal(cell);
    // Vertices stand for taps: off by up to half a micropolygon, 0.01.
    check_against(brute_force(cell, slopes), found, 0.012);
    CHECK(found.variance < 0.002f);
  }
}

TEST_CASE("bumps finer than a cell are its scatter") {
  TestScene test;
  const auto slopes = [](float i, float j) {
    return glm::vec2(0.5f * std::sin(1.7f * i + 0.4f * j), 0.4f * std::sin(2.3f * j));
  };
  const auto grid = grid_with_slopes(test.add_surface("matte"), slopes);
  const CellPoint cell = cell_of(*grid, {16, 0}, {0, 16});
  const Moments m = brute_force(cell, slopes);
  REQUIRE(m.variance > 0.1);
  // 64 of the 256 vertices inside are looked at.
  check_against(m, cell_normal(cell), 0.06);

  // Seen one vertex at a time the same surface would be all slope and no scatter.
  CHECK(cell_normal(cell_of(*grid, {0.5f, 0}, {0, 0.5f})).variance == 0.0f);
}

TEST_CASE("a small cell interpolates the vertices' normals") {
  TestScene test;
  const auto grid = grid_with_slopes(test.add_surface("matte"), [](float i, float j) {
    return glm::vec2(0.1f * i - 1.5f, 0.05f * j);
  });
  const CellNormal found = cell_normal(cell_of(*grid, {1, 0}, {0, 1}));
  const size_t a = 16 * 33 + 16, d = a + 33 + 1;
  glm::vec3 mean(0.0f);
  for (int axis = 0; axis < 3; ++axis) mean[axis] = grid->N(axis)[a] + grid->N(axis)[d];
  CHECK(glm::length(found.N - glm::normalize(mean)) < 1e-6f);
  for (int axis = 0; axis < 3; ++axis) {
    const float *N = grid->N(axis), wide = (N[a + 2] - N[a - 1]) / 3.0f;
    CHECK(found.dNdx[axis] == Approx(wide).margin(1e-6));
  }
}

TEST_CASE("normals that cancel, and cells larger than the grid, give finite values") {
  TestScene test;
  const auto around = grid_with_slopes(test.add_surface("matte"), [](float i, float) {
    return glm::vec2(int(i) % 2 == 0 ? 1e6f : -1e6f, 0.0f);
  });
  for (const float size : {2.0f, 8.0f, 1e6f}) {
    const CellNormal found = cell_normal(cell_of(*around, {size, 0}, {0, size}));
    CHECK(std::isfinite(found.variance));
    CHECK(std::isfinite(glm::length(found.dNdx)));
    CHECK(glm::length(found.N) < 1.0001f);
  }
}
