// How far micropolygons say that their surface may be, against surfaces whose distance is known.

#include <catch2/catch.hpp>

#include <glm/gtc/matrix_transform.hpp>

#include "dice/whole_scene.h"
#include "rays/near_range.h"
#include "tests/rays/ray_scene.h"

using namespace tessera;
using namespace tessera::test;

namespace {

Grids coarse_grids(DiceScene& scene) {
  scene.settings.dicing_rate = 100;
  return dice_whole_scene(scene.scene, Camera(scene.scene.camera), scene.settings,
                          scene.diagnostics);
}

glm::dvec3 position(const Grid& grid, int key, int vertex) {
  return {grid.P(key, 0)[vertex], grid.P(key, 1)[vertex], grid.P(key, 2)[vertex]};
}

/// Over all micropolygons.
NearRange largest(const Grids& grids) {
  NearRange most;
  for (const auto& grid : grids) {
    for (const NearRange& r : near_ranges(*grid)) {
      most.height = std::max(most.height, r.height);
      most.reach = std::max(most.reach, r.reach);
    }
  }
  return most;
}

/// Bezier points of a sheet y = bend * x^2 over [-1, 1]^2 at depth 4.
std::vector<glm::vec3> sheet(float bend) {
  const float square[4] = {1, -1.0f / 3, -1.0f / 3, 1}, line[4] = {-1, -1.0f / 3, 1.0f / 3, 1};
  std::vector<glm::vec3> points;
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) points.emplace_back(line[i], bend * square[i], line[j] + 4);
  }
  return points;
}

}  // namespace

TEST_CASE("near range: a sphere is within height of its micropolygons, and not far below it",
          "[rays]") {
  DiceScene scene;
  Quadric sphere;
  sphere.parameters = {{1, -1, 1, 360}};
  const glm::dvec3 centre(0, 0, 4);
  scene.add(geometry(sphere), glm::translate(glm::dmat4(1.0), centre));
  for (const auto& grid : coarse_grids(scene)) {
    const std::vector<NearRange> ranges = near_ranges(*grid);
    REQUIRE(ranges.size() == size_t(grid->micropolygon_count()));
    for (uint32_t t = 0; t < 2 * ranges.size(); ++t) {
      const auto corners = grid->triangle_corners(t);
      const glm::dvec3 a = position(*grid, 0, corners[0]), b = position(*grid, 0, corners[1]),
                       c = position(*grid, 0, corners[2]);
      const double area = glm::length(glm::cross(b - a, c - a));
      const double side = std::max({glm::length(b - a), glm::length(c - a), glm::length(c - b)});
      if (area < 1e-3 * side * side) continue;  // at edges and poles
      const double sag = 1 - glm::length((a + b + c) / 3.0 - centre);
      const NearRange& range = ranges[t / 2];
      CHECK(double(range.height) > 2 * sag);
      CHECK(double(range.height) < 6 * side * side);
      CHECK(double(range.reach) > side);
      CHECK(double(range.reach) < 3 * side);
    }
  }
}

TEST_CASE("near range: what is flat deviates by nothing", "[rays]") {
  DiceScene scene;
  scene.add(geometry(bicubic_mesh(), sheet(0)));
  // Four corners with normals that pretend a dome.
  Geometry polygon = geometry(PolygonMesh{{1}, {4}, {0, 1, 2, 3}},
                              {{-1, -1, 3}, {1, -1, 3}, {1, -1, 5}, {-1, -1, 5}});
  Parameter normals;
  normals.name = "N";
  normals.storage = StorageClass::vertex;
  normals.type = ValueType::normal;
  normals.numbers = {-1, 1, -1, 1, 1, -1, 1, 1, 1, -1, 1, 1};
  polygon.primvars.push_back(normals);
  scene.add(std::move(polygon));
  const Grids grids = coarse_grids(scene);
  REQUIRE(grids.size() >= 2);
  const Grid& last = *grids.back();
  REQUIRE(std::abs(last.N(0)[0] - last.N(0)[last.u_count]) > 0.1f);
  CHECK(largest(grids).height < 1e-5f);
  CHECK(largest(grids).reach > 0.05f);
}

TEST_CASE("near range: a sheet that bends later counts as bent", "[rays]") {
  DiceScene scene;
  Geometry g = geometry(bicubic_mesh(), sheet(0));
  g.key_times = {0, 1};
  g.P_object.push_back(sheet(0.5f));
  scene.add(std::move(g));
  const Grids grids = coarse_grids(scene);
  REQUIRE(grids.front()->u_count >= 4);
  // 0.5 x^2 deviates by h^2 / 8 over a side of h in x.
  const float h = 2.0f / float(grids.front()->u_count * 2);
  for (const auto& grid : grids) {
    for (const NearRange& range : near_ranges(*grid)) CHECK(range.height > h * h / 8);
  }
}

TEST_CASE("near range: a quadrangle that twists later counts as twisted", "[rays]") {
  DiceScene scene;
  Geometry g = geometry(PatchMesh{}, {{-1, 0, 3}, {1, 0, 3}, {-1, 0, 5}, {1, 0, 5}});
  g.key_times = {0, 1};
  g.P_object.push_back({{-1, 0.5f, 3}, {1, -0.5f, 3}, {-1, -0.5f, 5}, {1, 0.5f, 5}});
  scene.add(std::move(g));
  scene.settings.dicing_rate = 1e6f;
  const Grids grids =
      dice_whole_scene(scene.scene, Camera(scene.scene.camera), scene.settings, scene.diagnostics);
  REQUIRE(grids.size() == 1);
  REQUIRE(grids[0]->micropolygon_count() == 1);
  CHECK(near_ranges(*grids[0])[0].height > 0.5f);  // between its diagonals
}

TEST_CASE("near range: a grid of one micropolygon knows its bend from its normals", "[rays]") {
  DiceScene scene;
  scene.add(geometry(bicubic_mesh(), sheet(0.5f)));
  scene.settings.dicing_rate = 1e6f;
  const Grids grids =
      dice_whole_scene(scene.scene, Camera(scene.scene.camera), scene.settings, scene.diagnostics);
  REQUIRE(grids.size() == 1);
  REQUIRE(grids[0]->micropolygon_count() == 1);
  CHECK(near_ranges(*grids[0])[0].height > 0.5f);  // the bottom of the valley
}
