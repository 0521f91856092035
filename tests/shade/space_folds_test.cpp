// Grids that fold, wind, degenerate or cross the camera plane: their shading space mixes nothing
// and stays finite.

#include <catch2/catch.hpp>

#include <limits>

#include "shade/cell_points.h"
#include "tests/shade/space_fixtures.h"

using namespace tessera;
using namespace tessera::test;

namespace {

struct FoldScene : TestScene {
  const Surface& surface = add_surface("constant");
  FoldScene() {
    scene.camera.projection = Projection::orthographic;
    bind();
  }
  std::unique_ptr<const ShadingSpace> space(const Grid& grid,
                                            const ShadingSpaceSettings& settings) const {
    auto result = std::make_unique<ShadingSpace>(grid, *camera, settings);
    result->prepare_search();
    return result;
  }
};

/// Counts points whose cell is shaded elsewhere than `same` allows.
template <class Same>
size_t mixed(const ShadingSpace& space, const Grid& grid, const Same& same) {
  size_t count = 0;
  for (const SurfacePoint& p : inner_points(grid, 12)) {
    const SurfacePoint at = space.shading_point(space.cell_of(p));
    CHECK(inside_triangle(at));
    count += !same(p, at);
  }
  return count;
}

/// Not +-infinity or NaN, at every point and every cell that is hit.
void check_finite(const ShadingSpace& space, const Grid& grid) {
  size_t bad = 0;
  for (const SurfacePoint& p : dense_points(grid, 4)) {
    const ShadingCell cell = space.cell_of(p);
    const SurfacePoint at = space.shading_point(cell);
    bad += !inside_triangle(at) || at.triangle >= 2 * uint32_t(grid.micropolygon_count());
    bad += cell.x < 0 || cell.y < 0 || cell.x >= ShadingCell::most || cell.y >= ShadingCell::most;
    for (const SurfacePoint& q : {p, at}) {
      const CellFootprint f = space.footprint(q);
      for (const float x : {f.ij_per_x.x, f.ij_per_x.y, f.ij_per_y.x, f.ij_per_y.y})
        bad +=
            !std::isfinite(x) || std::abs(x) > 1.001f * float(std::max(grid.u_count, grid.v_count));
    }
  }
  CHECK(bad == 0);
}

}  // namespace

TEST_CASE("three layers of a fold are not mixed") {
  FoldScene test;
  // x runs right, left, right over u, a third each; turns are at columns 7 and 14, not at borders
  // of blocks.
  const auto fold = make_grid(test.surface, 21, 6, [](float u, float v) {
    const float s = 3 * u, x = s < 1 ? s : s < 2 ? 2 - s : s - 2;
    return glm::vec3(0.4f * x - 0.2f + 0.01f * v, 0.3f * v, 2 + s);
  });
  for (const ShadingSpaceSettings& settings :
       {raster_cells(), raster_cells(0.2f), grid_cells(0, 0.1f, 1),
        grid_cells(0.5f, 0.05f, 0.3f)}) {
    const auto held = test.space(*fold, settings);
    const ShadingSpace& space = *held;
    CHECK(mixed(space, *fold, [&](const SurfacePoint& p, const SurfacePoint& at) {
            return column_of(*fold, p) / 7 == column_of(*fold, at) / 7;
          }) == 0);
    check_finite(space, *fold);
  }
}

TEST_CASE("the two sides of a silhouette are not mixed") {
  TestScene test;
  const Surface& surface = test.add_surface("constant");
  test.bind();
  const auto sphere = make_grid(surface, 20, 12, [](float u, float v) {
    const float angle = 3.4f * u, height = 1.6f * v - 0.8f;
    const float r = std::sqrt(1 - height * height);
    return glm::vec3(r * std::cos(angle), height, 4 - r * std::sin(angle + 0.9f));
  });
  const auto turn = [&](const SurfacePoint& p) {
    const glm::dvec2 a = raster_of(*sphere, {p.triangle, 0, 0}),
                     b = raster_of(*sphere, {p.triangle, 1, 0}),
                     c = raster_of(*sphere, {p.triangle, 0, 1});
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) > 0;
  };
  size_t front = 0;
  for (const SurfacePoint& p : inner_points(*sphere, 1)) front += turn(p);
  REQUIRE(front > 50);
  REQUIRE(front < 430);
  for (const ShadingSpaceSettings& settings : {raster_cells(), grid_cells(0.5f, 0.05f, 0.3f)}) {
    ShadingSpace space(*sphere, *test.camera, settings);
    space.prepare_search();
    CHECK(mixed(space, *sphere, [&](const SurfacePoint& p, const SurfacePoint& at) {
            return turn(p) == turn(at);
          }) == 0);
    check_finite(space, *sphere);
  }
}

TEST_CASE("a ramp that winds over itself with one orientation is not mixed") {
  FoldScene test;
  // Two and a half turns, 16 micropolygons each; a turn is 1 unit deep.
  const auto ramp = make_grid(test.surface, 40, 4, [](float u, float v) {
    const float turns = 2.5f * u, angle = 6.2831853f * turns, r = 0.2f + 0.3f * v;
    return glm::vec3(r * std::cos(angle), r * std::sin(angle), 2 + turns);
  });
  for (const ShadingSpaceSettings& settings :
       {raster_cells(), raster_cells(0.3f), grid_cells(0.5f, 0.1f, 0.5f)}) {
    const auto held = test.space(*ramp, settings);
    const ShadingSpace& space = *held;
    CHECK(mixed(space, *ramp, [&](const SurfacePoint& p, const SurfacePoint& at) {
            return std::abs(position(*ramp, p).z - position(*ramp, at).z) <= 0.5;
          }) == 0);
    check_finite(space, *ramp);
  }
}

TEST_CASE("where a pleat runs out into its sheet, nothing is mixed over more than a block") {
  FoldScene test;
  // The pleat is deepest at v = 0 and gone from v = 1/2 on: both outer layers are one sheet.
  const auto pleat = make_grid(test.surface, 32, 32, [](float u, float v) {
    const float depth = std::max(0.0f, 1 - 2 * v);
    return glm::vec3(0.6f * u + 0.1f * depth * std::sin(19 * u), 0.6f * v, 2 + u);
  });
  const auto place_of = [&](const SurfacePoint& p) {
    return glm::ivec2(column_of(*pleat, p), int(p.triangle / 2) / pleat->u_count);
  };
  for (const ShadingSpaceSettings& settings : {raster_cells(), grid_cells(0, 0.2f, 1)}) {
    const auto held = test.space(*pleat, settings);
    CHECK(mixed(*held, *pleat, [&](const SurfacePoint& p, const SurfacePoint& at) {
            return place_of(p) / 8 == place_of(at) / 8;
          }) == 0);
  }
}

TEST_CASE("a primitive variable of one side never shows on the other") {
  FoldScene test;
  const auto fold = make_grid(test.surface, 20, 8, [](float u, float v) {
    const float x = u < 0.5f ? u : 1 - u;
    return glm::vec3(0.5f * x, 0.3f * v, 2 + u);
  });
  const auto side = add_primvar(*fold, "Cs", ValueType::color, [](float u, float) {
    return std::vector<float>{u, u, u};
  });
  const auto held = test.space(*fold, raster_cells(0.5f));
  const ShadingSpace& space = *held;
  for (const SurfacePoint& p : inner_points(*fold, 8)) {
    const SurfacePoint at = space.shading_point(space.cell_of(p));
    const CellPoint cell{fold.get(), at, space.footprint(at)};
    const CellPoints batch({&cell, 1}, *test.camera);
    const float shown = batch.points().Cs[0].x;  // at the crease, 0.5 is of both sides
    CHECK((column_of(*fold, p) < 10 ? shown <= 0.5f : shown >= 0.5f));
  }
}

TEST_CASE("degenerate grids have finite cells") {
  FoldScene test;
  const auto shapes = std::vector<std::function<glm::vec3(float, float)>>{
      // A rim collapsed to a pole; a line; a point; one micropolygon turned over; a bow tie.
      [](float u, float v) { return glm::vec3(v * (u - 0.5f), v, 3); },
      [](float u, float v) { return glm::vec3(u + v, u + v, 3); },
      [](float, float) { return glm::vec3(0.25f, 0.3f, 3); },
      [](float u, float v) {
        return u > 0.3f && u < 0.7f && v == 0.5f ? glm::vec3(0, -0.5f, 3) : glm::vec3(u, v, 3);
      },
      [](float u, float v) { return glm::vec3((u - 0.5f) * (v - 0.5f), v, 3); },
      [](float u, float v) { return glm::vec3(1e-20f * u, 1e-25f * v, 3); },
      [](float u, float v) { return glm::vec3(1e-30f * u, v, 3); },
  };
  for (size_t k = 0; k < shapes.size(); ++k) {
    for (const int count : {1, 4}) {
      const auto grid = make_grid(test.surface, count, count, shapes[k]);
      for (const ShadingSpaceSettings& settings :
           {raster_cells(), grid_cells(0.3f, 0.1f, 1), grid_cells(0, 1e-7f, 1e-7f)}) {
        INFO("shape " << k << " count " << count);
        const auto held = test.space(*grid, settings);
        const ShadingSpace& space = *held;
        check_finite(space, *grid);
        // A sample and its shading point are no farther apart than a cell.
        for (const SurfacePoint& p : inner_points(*grid, 3)) {
          const ShadingCell cell = space.cell_of(p);
          const glm::vec2 off = space.at(space.shading_point(cell)) -
                                glm::vec2(float(cell.x) + 0.5f, float(cell.y) + 0.5f);
          CHECK(std::max(std::abs(off.x), std::abs(off.y)) < 0.501f);
        }
      }
    }
  }
}

TEST_CASE("grids that reach behind the camera plane use their own parameters") {
  TestScene test;
  const Surface& surface = test.add_surface("constant");
  test.bind();
  const auto crossing = make_grid(
      surface, 6, 4, [](float u, float v) { return glm::vec3(v - 0.5f, -0.3f, 3 * u - 0.9f); });
  const auto touching =
      make_grid(surface, 2, 2, [](float u, float v) { return glm::vec3(v - 0.5f, -0.3f, u); });
  const auto broken = make_grid(surface, 2, 2, [](float u, float v) {
    return glm::vec3(u, v, u == 1 && v == 1 ? std::numeric_limits<float>::quiet_NaN() : 2.0f);
  });
  for (const auto& grid : {crossing, touching, broken}) {
    for (const int per_edge : {1, 3}) {
      ShadingSpaceSettings settings = grid_cells(0.3f, 0.1f, 1);
      settings.cells_per_edge = per_edge;
      ShadingSpace space(*grid, *test.camera, settings);
      space.prepare_search();
      REQUIRE(space.parametric());
      check_finite(space, *grid);
      std::vector<uint64_t> keys;
      for (const SurfacePoint& p : inner_points(*grid, 300)) {
        // Corner a of the micropolygon, then b or c, then d (dice/grid.h).
        const int m = int(p.triangle / 2);
        const bool first = p.triangle % 2 == 0;
        const float x = float(m % grid->u_count) + (first ? p.b1 + p.b2 : p.b1);
        const float y = float(m / grid->u_count) + (first ? p.b2 : p.b1 + p.b2);
        const ShadingCell cell = space.cell_of(p);
        const float px = x * float(per_edge), py = y * float(per_edge);
        if (std::abs(px - std::round(px)) > 1e-4f) CHECK(cell.x == int(px));
        if (std::abs(py - std::round(py)) > 1e-4f) CHECK(cell.y == int(py));
        keys.push_back(cell.key());
        const glm::vec2 centre(float(cell.x) + 0.5f, float(cell.y) + 0.5f);
        CHECK(glm::distance(space.at(space.shading_point(cell)), centre) < 1e-4f);
        const CellFootprint f = space.footprint(p);
        CHECK(f.ij_per_x.x == Approx(1.0 / per_edge));
        CHECK(f.ij_per_y.y == Approx(1.0 / per_edge));
        CHECK(f.ij_per_x.y == Approx(0).margin(1e-6));
      }
      std::ranges::sort(keys);
      keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
      CHECK(int(keys.size()) == grid->micropolygon_count() * per_edge * per_edge);
    }
  }
}

TEST_CASE("the size of the scene does not show in its cells") {
  TestScene test;
  const Surface& surface = test.add_surface("constant");
  test.bind();
  const auto grid_of = [&](float scale) {
    return make_grid(surface, 6, 6, [scale](float u, float v) { return scale * bumpy(u, v); });
  };
  const auto unit = grid_of(1);
  for (const float scale : {1e-6f, 1e7f}) {
    const auto scaled = grid_of(scale);
    for (const ShadingSpaceSettings& settings : {raster_cells(), grid_cells(0.5f, 0.1f, 0.7f)}) {
      ShadingSpace a(*unit, *test.camera, settings), b(*scaled, *test.camera, settings);
      a.prepare_search(), b.prepare_search();
      REQUIRE_FALSE(b.parametric());
      for (const SurfacePoint& p : inner_points(*unit, 10)) {
        CHECK(glm::distance(a.at(p), b.at(p)) < 1e-4f);
        const ShadingCell cell = a.cell_of(p);
        CHECK(glm::distance(a.at(a.shading_point(cell)), b.at(b.shading_point(cell))) < 1e-3f);
        CHECK(glm::distance(a.footprint(p).ij_per_x, b.footprint(p).ij_per_x) < 1e-3f);
      }
      check_finite(b, *scaled);
    }
  }
}

TEST_CASE("the footprint of a cell on a plane is the derivative of position along its axes") {
  TestScene test;
  const Surface& surface = test.add_surface("constant");
  test.bind();
  // P = O + u A + v B; small micropolygons, so that differences over them are derivatives.
  const glm::dvec3 O(-0.4, -0.3, 3), A(0.6, 0.2, 0.5), B(-0.1, 0.7, -0.3);
  const auto grid = make_grid(surface, 30, 30, [&](float u, float v) {
    return glm::vec3(O + double(u) * A + double(v) * B);
  });
  const glm::dvec3 normal = glm::cross(A, B);
  const auto on_plane = [&](const glm::dvec2& raster) {
    const glm::dvec3 ray((raster.x - 50) / 50, (50 - raster.y) / 50, 1);
    return ray * (glm::dot(normal, O) / glm::dot(normal, ray));
  };
  for (const ShadingSpaceSettings& settings :
       {raster_cells(), raster_cells(0.5f), grid_cells(0.8f, 0.25f, 0.9f)}) {
    ShadingSpace space(*grid, *test.camera, settings);
    space.prepare_search();
    for (const SurfacePoint& p : inner_points(*grid, 1)) {
      const ShadingCell cell = space.cell_of(p);
      const SurfacePoint at = space.shading_point(cell);
      const CellPoint cell_point{grid.get(), at, space.footprint(at)};
      const CellPoints batch({&cell_point, 1}, *test.camera);
      // The cell's own axes, as vectors on the raster, from the lattice at three points.
      const glm::dvec2 here(space.raster_of(at));
      const double d_mu = settings.extents.d_mu, d_perp = settings.extents.d_perp;
      const glm::dvec2 e(settings.extents.direction);
      // Cells of a grid's own lattice are stretched to fit: at most one cell in its number.
      const double slack = settings.anchor == LatticeAnchor::grid ? 0.25 : 0.04;
      for (const auto& [axis, found] :
           {std::pair{e / d_mu, batch.points().dPdx[0]},
            std::pair{glm::dvec2(-e.y, e.x) / d_perp, batch.points().dPdy[0]}}) {
        const glm::dvec3 expected =
            (on_plane(here + 0.001 * axis) - on_plane(here - 0.001 * axis)) / 0.002;
        // A footprint has no sign.
        const double error = std::min(glm::length(expected - glm::dvec3(found)),
                                      glm::length(expected + glm::dvec3(found)));
        CHECK(error < slack * glm::length(expected));
        const double along = std::abs(glm::dot(expected, glm::dvec3(found))) /
                             (glm::length(expected) * double(glm::length(found)));
        CHECK(along > 0.999);
      }
    }
  }
}
