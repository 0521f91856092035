// Grids of all of a scene, seen or not.

#include <catch2/catch.hpp>

#include <tbb/global_control.h>

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "dice/whole_scene.h"
#include "tests/dice/dice_scene.h"

using namespace tessera;
using namespace tessera::test;

namespace {

Geometry unit_sphere() {
  Quadric sphere;
  sphere.kind = Quadric::Kind::sphere;
  sphere.parameters = {{1, -1, 1, 360}};
  return geometry(sphere);
}

Geometry rectangle(float width, float depth) {
  PatchMesh mesh;
  return geometry(mesh,
                  {{-width, 0, -depth}, {width, 0, -depth}, {-width, 0, depth}, {width, 0, depth}});
}

glm::dmat4 moved(double x, double y, double z) {
  return glm::translate(glm::dmat4(1.0), glm::dvec3(x, y, z));
}

Grids dice_whole(DiceScene& scene, size_t most = most_micropolygons_of_surface) {
  return dice_whole_scene(scene.scene, Camera(scene.scene.camera), scene.settings,
                          scene.diagnostics, most);
}

std::map<uint32_t, size_t> micropolygons_by_surface(const Grids& grids) {
  std::map<uint32_t, size_t> counts;
  for (const auto& grid : grids) counts[grid->id.surface] += size_t(grid->micropolygon_count());
  return counts;
}

}  // namespace

TEST_CASE("whole scene: surfaces lie anywhere about the eye", "[whole_scene]") {
  DiceScene scene;
  scene.settings.dicing_rate = 16;
  const double d = 8;
  for (const glm::dmat4& place : {moved(0, 0, d), moved(0, 0, -d), moved(d, 0, 0), moved(0, -d, 0)})
    scene.add(unit_sphere(), place);
  const auto counts = micropolygons_by_surface(dice_whole(scene));
  REQUIRE(counts.size() == 4);
  // 160 x 120 pixels in 60 degrees: 104 pixels for a unit at a distance of 1.
  const double pixels = 120 / (2 * std::tan(glm::radians(30.0))) / d;
  const double expected = 4 * glm::pi<double>() * pixels * pixels / 16;
  for (const auto& [surface, count] : counts) {
    // A sphere's poles are diced as finely as its equator. Out of sight sides are twice as long.
    const double here = surface == 0 ? expected : expected / 4;
    CHECK(double(count) > here);
    CHECK(double(count) < 3 * here);
  }
}

TEST_CASE("whole scene: the eye in the middle of a floor costs a bounded number", "[whole_scene]") {
  DiceScene scene;
  scene.settings.dicing_rate = 4;
  scene.add(rectangle(1000, 1000), moved(0, -1e-3, 0));
  const Grids grids = dice_whole(scene);
  size_t count = 0;
  double area = 0;
  for (const auto& grid : grids) {
    count += size_t(grid->micropolygon_count());
    const int last = grid->vertex_count() - 1;
    area += double(grid->P(0, 0)[last] - grid->P(0, 0)[0]) *
            double(grid->P(0, 2)[last] - grid->P(0, 2)[0]);
  }
  CHECK(area == Approx(4e6).epsilon(1e-3));
  CHECK(count < 200000);
  CHECK(scene.diagnostics.lines().empty());
}

TEST_CASE("whole scene: a surface that asks for too much is diced coarser, and reported",
          "[whole_scene]") {
  DiceScene scene;
  scene.settings.dicing_rate = 1e-4f;
  scene.add(unit_sphere(), moved(0, 0, 5));
  scene.add(unit_sphere(), moved(1e4, 0, 0));
  const auto counts = micropolygons_by_surface(dice_whole(scene, 5000));
  CHECK(counts.at(0) <= 5000);
  CHECK(counts.at(0) > 5000 / 8);
  CHECK(counts.at(1) <= 5000);
  REQUIRE(scene.diagnostics.lines().size() == 1);
  CHECK(scene.diagnostics.lines()[0].find("more than 5000 micropolygons") != std::string::npos);
}

TEST_CASE("whole scene: grids come in scene order, the same for any number of threads",
          "[whole_scene]") {
  DiceScene scene;
  scene.add(unit_sphere(), moved(0, 0, -4));
  scene.add(geometry(torus_cage(16, 12), torus_points(16, 12)), moved(0, 5, 1));
  scene.add(rectangle(30, 30), moved(0, -1, 0));
  const auto with_threads = [&](size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return dice_whole(scene);
  };
  const Grids one = with_threads(1), two = with_threads(2);
  REQUIRE(one.size() == two.size());
  REQUIRE(one.size() > 10);
  for (size_t g = 0; g < one.size(); ++g) {
    CHECK(one[g]->id == two[g]->id);
    CHECK(one[g]->P_camera == two[g]->P_camera);
    if (g == 0) continue;
    const GridId &before = one[g - 1]->id, &id = one[g]->id;
    CHECK(std::pair(before.surface, before.face) <= std::pair(id.surface, id.face));
  }
}

TEST_CASE("whole scene: grids of a surface meet without gaps", "[whole_scene]") {
  DiceScene scene;
  scene.add(geometry(torus_cage(16, 12), torus_points(16, 12)), moved(0, 0, -2));
  // Sides of micropolygons, by the bits of their ends: every one is there twice on a closed
  // surface.
  using Vertex = std::array<float, 3>;
  std::map<std::pair<Vertex, Vertex>, int> sides;
  for (const auto& grid : dice_whole(scene)) {
    const auto vertex = [&](int v) {
      return Vertex{grid->P(0, 0)[v], grid->P(0, 1)[v], grid->P(0, 2)[v]};
    };
    const auto add = [&](int v, int w) {
      Vertex a = vertex(v), b = vertex(w);
      if (a != b) ++sides[std::minmax(a, b)];
    };
    const int row = grid->u_count + 1, top = grid->v_count * row;
    for (int i = 0; i < grid->u_count; ++i) add(i, i + 1), add(top + i, top + i + 1);
    for (int j = 0; j < grid->v_count; ++j) {
      add(j * row, (j + 1) * row), add(j * row + grid->u_count, (j + 1) * row + grid->u_count);
    }
  }
  CHECK(sides.size() > 100);
  CHECK(std::all_of(sides.begin(), sides.end(), [](const auto& s) { return s.second == 2; }));
}

TEST_CASE("whole scene: what cannot be evaluated is reported and left out", "[whole_scene]") {
  DiceScene scene;
  scene.add(geometry(nurbs_without_spans(), std::vector<glm::vec3>(4)));
  scene.add(unit_sphere(), moved(0, 0, NAN));
  scene.add(unit_sphere(), moved(0, 0, 1e30));
  scene.add(unit_sphere(), moved(0, 0, 3));
  const auto counts = micropolygons_by_surface(dice_whole(scene));
  CHECK(counts.count(3) == 1);
  CHECK(counts.count(0) + counts.count(1) == 0);
  REQUIRE(scene.diagnostics.lines().size() >= 1);
  CHECK(scene.diagnostics.lines()[0].find("knot span") != std::string::npos);
}
