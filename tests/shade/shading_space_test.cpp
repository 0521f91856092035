// Shading space against projections in double and brute force over the points of a grid.

#include <catch2/catch.hpp>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "tests/shade/space_fixtures.h"

using namespace tessera;
using namespace tessera::test;

namespace {

struct SpaceScene : TestScene {
  const Surface& surface = add_surface("constant");
  SpaceScene() { bind(); }

  ShadingSpace space(const Grid& grid, const ShadingSpaceSettings& settings) const {
    return ShadingSpace(grid, *camera, settings);
  }
};

std::vector<ShadingSpaceSettings> several_settings() {
  return {raster_cells(),           raster_cells(0.31f),        raster_cells(2.5f),
          grid_cells(0, 1, 1),      grid_cells(0.7f, 0.05f, 1), grid_cells(-2.1f, 0.11f, 0.4f),
          grid_cells(1.3f, 3, 0.2f)};
}

double distance_to_centre(const ShadingSpace& space, const SurfacePoint& p,
                          const ShadingCell& cell) {
  const glm::dvec2 at(space.at(p));
  return glm::distance(at, glm::dvec2(cell.x + 0.5, cell.y + 0.5));
}

/// Compares the shading point of every cell that `points` hit with the nearest of `points` in the
/// cell's sheet. No point of `points` may be nearer.
void check_nearest(const ShadingSpace& space, const std::vector<SurfacePoint>& points) {
  std::map<uint32_t, std::vector<glm::dvec2>> of_sheet;
  std::map<uint64_t, ShadingCell> cells;
  for (const SurfacePoint& p : points) {
    const ShadingCell cell = space.cell_of(p);
    of_sheet[cell.chart].push_back(glm::dvec2(space.at(p)));
    cells[cell.key()] = cell;
  }
  double most_too_far = 0;
  size_t outside = 0, other_sheets = 0;
  for (const auto& [key, cell] : cells) {
    const SurfacePoint chosen = space.shading_point(cell);
    outside += !inside_triangle(chosen);
    other_sheets += space.cell_of(chosen).chart != cell.chart;
    const glm::dvec2 centre(cell.x + 0.5, cell.y + 0.5);
    double least = std::numeric_limits<double>::infinity();
    for (const glm::dvec2& at : of_sheet[cell.chart])
      least = std::min(least, glm::distance(at, centre));
    most_too_far = std::max(most_too_far, distance_to_centre(space, chosen, cell) - least);
  }
  CHECK(outside == 0);
  CHECK(other_sheets == 0);
  CHECK(most_too_far < 2e-5);  // rounding of lattice coordinates of a hundred or so
}

}  // namespace

TEST_CASE("points lie in shading space where they are seen at shutter open") {
  SpaceScene test;
  const auto grid = make_grid(test.surface, 6, 5, bumpy);
  // A second key, far away: what moves later does not matter.
  add_key(*grid, 1.0f, [](const glm::vec3& P) { return 2.0f * P + 1.0f; });
  for (const ShadingSpaceSettings& settings : several_settings()) {
    const ShadingSpace space = test.space(*grid, settings);
    REQUIRE_FALSE(space.parametric());
    const double d = settings.extents.d_mu, d_perp = settings.extents.d_perp;
    const glm::dvec2 e(settings.extents.direction), f(-e.y, e.x);
    double worst = 0;
    glm::dvec2 low(1e9), high(-1e9);
    for (const SurfacePoint& p : inner_points(*grid, 20)) {
      const glm::dvec2 expected = raster_of(*grid, p), found(space.raster_of(p));
      worst = std::max(worst, glm::distance(expected, found));
      if (settings.anchor == LatticeAnchor::grid) continue;
      // The lattice is the raster scaled, but for a whole offset.
      const glm::dvec2 offset =
          glm::dvec2(space.at(p)) -
          glm::dvec2(d * glm::dot(e, expected), d_perp * glm::dot(f, expected));
      low = glm::min(low, offset), high = glm::max(high, offset);
    }
    CHECK(worst < 1e-4);
    if (settings.anchor == LatticeAnchor::grid) continue;
    for (int axis = 0; axis < 2; ++axis) {
      CHECK(high[axis] - low[axis] < 1e-4);
      CHECK(std::abs(low[axis] - std::round(low[axis])) < 1e-4);
    }
  }
}

TEST_CASE("orthographic cameras have a shading space too") {
  TestScene test;
  test.scene.camera.projection = Projection::orthographic;
  const Surface& surface = test.add_surface("constant");
  test.bind();
  const auto grid = make_grid(surface, 3, 3, [](float u, float v) {
    return glm::vec3(u - 0.5f, 1.5f * v - 0.7f, 2.0f + 3.0f * u * v);
  });
  const ShadingSpace space(*grid, *test.camera, grid_cells(0.4f, 0.3f, 0.7f));
  for (const SurfacePoint& p : inner_points(*grid, 10)) {
    const glm::dvec3 P = position(*grid, p);
    CHECK(glm::distance(glm::dvec2(space.raster_of(p)), glm::dvec2(50 + 50 * P.x, 50 - 50 * P.y)) <
          1e-4);
  }
}

TEST_CASE("cells of the raster are those of all grids, and lie over pixels") {
  SpaceScene test;
  const auto one = make_grid(test.surface, 4, 4, bumpy);
  const auto other = make_grid(
      test.surface, 3, 5, [](float u, float v) { return bumpy(0.7f * u - 0.9f, 0.9f * v - 0.8f); });
  for (const float per_pixel : {1.0f, 0.5f, 0.37f, 3.0f}) {
    for (const Grid* grid : {one.get(), other.get()}) {
      const ShadingSpace space = test.space(*grid, raster_cells(per_pixel));
      std::set<std::pair<int, int>> offsets;
      int wrong_over = 0;
      for (const SurfacePoint& p : inner_points(*grid, 30)) {
        const glm::dvec2 raster = raster_of(*grid, p);
        // Axes of the lattice are x and y of the raster, y down like it.
        const glm::dvec2 scaled = raster * double(per_pixel);
        const glm::dvec2 in_cell = scaled - glm::floor(scaled);
        if (std::min(in_cell.x, in_cell.y) < 1e-3 || std::max(in_cell.x, in_cell.y) > 0.999)
          continue;
        const ShadingCell cell = space.cell_of(p);
        offsets.insert({cell.x - int(std::floor(scaled.x)), cell.y - int(std::floor(scaled.y))});
        wrong_over += space.cell_over(glm::vec2(raster)) != glm::ivec2(cell.x, cell.y);
      }
      CHECK(wrong_over == 0);
      REQUIRE(offsets.size() == 1);
      CHECK(offsets.begin()->first % 2 == 0);  // blocks of 2 x 2 cells agree as well
      CHECK(offsets.begin()->second % 2 == 0);
    }
  }
}

TEST_CASE("a whole number of cells spans a grid, none larger than asked for") {
  SpaceScene test;
  const auto grid = make_grid(test.surface, 6, 5, bumpy);
  const auto points = dense_points(*grid, 12);
  for (const float angle : {0.0f, 0.6f, -1.9f}) {
    for (const float d_mu : {1.0f, 0.23f, 0.02f, 0.0001f}) {
      const float d_perp = 0.61f;
      const ShadingSpace space = test.space(*grid, grid_cells(angle, d_mu, d_perp));
      const glm::dvec2 e(std::cos(double(angle)), std::sin(double(angle)));
      const glm::dvec2 axes[] = {e, {-e.y, e.x}};
      const double per_pixel[] = {double(d_mu), double(d_perp)};
      for (int axis = 0; axis < 2; ++axis) {
        double low = 1e9, high = -1e9, at_low = 1e9, at_high = -1e9;
        std::map<int, std::pair<double, double>> of_cell;  // extent of each on the raster
        for (const SurfacePoint& p : points) {
          const double along = glm::dot(axes[axis], raster_of(*grid, p));
          const double at = space.at(p)[axis];
          low = std::min(low, along), high = std::max(high, along);
          at_low = std::min(at_low, at), at_high = std::max(at_high, at);
          const ShadingCell cell = space.cell_of(p);
          auto& range =
              of_cell.try_emplace(axis == 0 ? cell.x : cell.y, along, along).first->second;
          range = {std::min(range.first, along), std::max(range.second, along)};
        }
        const double asked = (high - low) * per_pixel[axis];
        const int cells = int(of_cell.size());
        CHECK(cells == std::max(1, int(std::ceil(asked - 1e-3))));
        CHECK(of_cell.begin()->first == 0);
        CHECK(of_cell.rbegin()->first == cells - 1);  // contiguous
        CHECK(at_low == Approx(0).margin(1e-3));
        CHECK(at_high == Approx(cells).margin(1e-3));
        for (const auto& [cell, range] : of_cell)
          CHECK((range.second - range.first) * per_pixel[axis] < 1.0 + 1e-3);
      }
    }
  }
}

TEST_CASE("a cell is shaded at the point of its sheet nearest its centre") {
  SpaceScene test;
  const auto crescent = [](float u, float v) {
    const float angle = 2.6f * u, r = 1 + 0.12f * v;
    return glm::vec3(2 * std::cos(angle) * r, 2 * std::sin(angle) * r - 1, 4.0f + v);
  };
  for (const auto& [shape, u_count, v_count] : {std::tuple{+bumpy, 5, 4},
                                                {+bumpy, 1, 1},
                                                {+bumpy, 9, 2},
                                                {+bumpy, 17, 16},
                                                {+crescent, 40, 4}}) {
    const auto grid = make_grid(test.surface, u_count, v_count, shape);
    const auto points = dense_points(*grid, u_count > 9 ? 5 : 16);
    for (const ShadingSpaceSettings& settings : several_settings()) {
      if (settings.extents.d_mu > 1 && u_count > 9) continue;
      ShadingSpace space = test.space(*grid, settings);
      space.prepare_search();
      INFO(u_count << " " << v_count << " d " << settings.extents.d_mu << " "
                   << settings.extents.d_perp);
      check_nearest(space, points);
    }
  }
}

TEST_CASE("the nearest point of a cell cut by a rim may lie outside the cell") {
  SpaceScene test;
  // A tilted square; its rims cut corners of cells that are many micropolygons wide.
  const auto grid = make_grid(test.surface, 80, 80, [](float u, float v) {
    return glm::vec3(8 * u - v - 4, 8 * v + u - 4, 4.0f);
  });
  ShadingSpace space = test.space(*grid, raster_cells(0.1f));
  space.prepare_search();
  check_nearest(space, dense_points(*grid, 4));
}

TEST_CASE("one large micropolygon, and a grid many times the frame") {
  SpaceScene test;
  const auto one = make_grid(test.surface, 1, 1, [](float u, float v) {
    return glm::vec3(4 * u - 2, 3 * v - 1.5f, 3 + u - v);
  });
  const auto wide = make_grid(test.surface, 8, 8, [](float u, float v) {
    return glm::vec3(4000 * (u - 0.5f), -1, 0.5f + 4000 * v);
  });
  for (const auto& grid : {one, wide}) {
    ShadingSpace space = test.space(*grid, raster_cells());
    space.prepare_search();
    // Where the grid covers a cell's centre, the shading point is seen there.
    size_t covered = 0;
    for (const SurfacePoint& p : inner_points(*grid, 400)) {
      const glm::dvec2 raster = raster_of(*grid, p);
      if (raster.x < 0 || raster.x > 100 || raster.y < 0 || raster.y > 100) continue;
      // 200000 pixels from the grid's end, a float knows its place to 1/64 at best.
      const glm::dvec2 in_pixel = glm::abs(raster - glm::floor(raster) - 0.5);
      if (std::max(in_pixel.x, in_pixel.y) > 0.45) continue;
      const SurfacePoint at = space.shading_point(space.cell_of(p));
      CHECK(inside_triangle(at));
      const glm::dvec2 off = raster_of(*grid, at) - (glm::floor(raster) + 0.5);
      covered += glm::length(off) < 0.02;
      CHECK(std::max(std::abs(off.x), std::abs(off.y)) < 0.54);
    }
    CHECK(covered > 100);
  }
}

TEST_CASE("keys tell all cells of the largest grids apart") {
  // 256 x 256 micropolygons that all turn otherwise than their neighbours are as many sheets as
  // triangles; coordinates stay below ShadingCell::most, and may be one over by rounding.
  std::set<uint64_t> keys;
  for (const uint32_t chart : {0u, 1u, 255u, 256u, 2u * 256 * 256 - 1})
    for (const int x : {0, 1, 255, ShadingCell::most - 1, ShadingCell::most})
      for (const int y : {0, 1, 255, ShadingCell::most - 1, ShadingCell::most})
        keys.insert(ShadingCell{chart, x, y}.key());
  CHECK(keys.size() == 5 * 5 * 5);
}
