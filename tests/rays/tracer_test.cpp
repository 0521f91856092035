// What callers may give a ray tracer, and what it does with a scene's attributes.

#include <catch2/catch.hpp>

#include <cstdlib>

#include <glm/gtc/matrix_transform.hpp>

#include "base/error.h"
#include "tests/rays/ray_scene.h"

using namespace tessera;
using namespace tessera::test;

namespace {

/// A square of size 2 that faces the eye at depth z.
void add_square(DiceScene& scene, float z, const Attributes& attributes = {}) {
  scene.add(geometry(PatchMesh{}, {{-1, -1, z}, {1, -1, z}, {-1, 1, z}, {1, 1, z}}),
            glm::dmat4(1.0), attributes);
}

Attributes with_opacity(const glm::vec3& opacity) {
  Attributes attributes;
  attributes.opacity = opacity;
  return attributes;
}

Attributes with_transmission(const Parameter& value) {
  Attributes attributes;
  attributes.user["visibility:transmission"] = value;
  return attributes;
}

const glm::vec3 ahead(0, 0, 1);

RayShadows look(const RayTracer& tracer, float far = INFINITY) {
  return shadow(tracer, one_ray({0.1f, 0.2f, 0}, ahead, far));
}

}  // namespace

TEST_CASE("a scene without surfaces has no ray tracer", "[rays]") {
  DiceScene scene;
  CHECK(tracer_of(scene) == nullptr);
}

TEST_CASE("a scene whose only surface cannot be evaluated answers rays all the same", "[rays]") {
  DiceScene scene;
  scene.add(geometry(nurbs_without_spans(), std::vector<glm::vec3>(4)));
  const auto tracer = tracer_of(scene);
  REQUIRE(tracer);
  CHECK(tracer->grids().empty());
  CHECK(look(*tracer).share[0] == 1.0f);
  CHECK(closest(*tracer, one_ray({0, 0, 0}, ahead)).distance[0] == INFINITY);
}

TEST_CASE("rays that are not rays meet nothing", "[rays]") {
  DiceScene scene;
  add_square(scene, 3);
  const auto tracer = tracer_of(scene);
  const glm::vec3 o(0.1f, 0.2f, 0);
  for (const Rays& rays :
       {one_ray({NAN, 0, 0}, ahead), one_ray(o, {0, NAN, 1}), one_ray(o, {0, 0, 0}),
        one_ray(o, ahead, NAN), one_ray(o, ahead, 0), one_ray(o, ahead, -5),
        one_ray(o, ahead, INFINITY, NAN), one_ray({0, INFINITY, 0}, ahead)}) {
    CHECK(closest(*tracer, rays).distance[0] == INFINITY);
    CHECK(shadow(*tracer, rays).share[0] == 1.0f);
    CHECK(shadow(*tracer, rays).distance[0] == INFINITY);
  }
  CHECK(closest(*tracer, Rays(0)).distance.empty());
}

TEST_CASE("distances are multiples of the direction, whatever its length", "[rays]") {
  DiceScene scene;
  add_square(scene, 3);
  const auto tracer = tracer_of(scene);
  for (const float length : {1e-30f, 1e-6f, 0.5f, 1.0f, 4.0f, 1e6f, 1e30f}) {
    const Rays rays = one_ray({0.1f, 0.2f, 0}, {0, 0, length});
    CHECK(closest(*tracer, rays).distance[0] == Approx(3 / double(length)).epsilon(1e-6));
    CHECK(shadow(*tracer, rays).distance[0] == Approx(3 / double(length)).epsilon(1e-6));
  }
}

TEST_CASE("opacity is the mean of three, and layers multiply", "[rays]") {
  DiceScene scene;
  add_square(scene, 3, with_opacity({0.1f, 0.2f, 0.6f}));
  add_square(scene, 2, with_opacity({0.5f, 0.5f, 0.5f}));
  add_square(scene, 5, with_opacity({7, 1, 2}));
  add_square(scene, 1, with_opacity({0, -3, 0}));
  const auto tracer = tracer_of(scene);
  CHECK(look(*tracer, 2).share[0] == 1.0f);
  CHECK(look(*tracer, 2.5f).share[0] == 0.5f);
  CHECK(double(look(*tracer, 4).share[0]) == Approx(0.35).epsilon(1e-6));
  CHECK(double(look(*tracer, 4).distance[0]) == Approx(2).epsilon(1e-6));
  CHECK(look(*tracer).share[0] == 0.0f);
  // Each of the three counts as what it can be.
  DiceScene beyond;
  add_square(beyond, 3, with_opacity({6, -3, 0}));
  CHECK(double(look(*tracer_of(beyond)).share[0]) == Approx(2.0 / 3).epsilon(1e-6));
  // The nearest is met whatever its opacity.
  CHECK(double(closest(*tracer, one_ray({0.1f, 0.2f, 0}, ahead)).distance[0]) ==
        Approx(1).epsilon(1e-6));
}

TEST_CASE("a ray through edges and vertices meets each layer once", "[rays]") {
  DiceScene scene;
  add_square(scene, 3, with_opacity(glm::vec3(0.5f)));
  const auto tracer = tracer_of(scene);
  REQUIRE(!tracer->grids().empty());
  for (const auto& grid : tracer->grids()) {
    for (int v = 0; v < grid->vertex_count(); ++v) {
      const float x = grid->P(0, 0)[v], y = grid->P(0, 1)[v];
      if (std::abs(x) > 0.99f || std::abs(y) > 0.99f) continue;
      CHECK(shadow(*tracer, one_ray({x, y, 0}, ahead)).share[0] == 0.5f);
      CHECK(shadow(*tracer, one_ray({x, y, 7}, -ahead)).share[0] == 0.5f);
    }
  }
}

TEST_CASE("each of very many layers that a ray meets on an edge counts once", "[rays]") {
  DiceScene scene;
  const int layers = 100;
  for (int k = 0; k < layers; ++k)
    add_square(scene, 3.0f + 0.1f * float(k), with_opacity(glm::vec3(0.01f)));
  RaySettings settings;
  settings.dicing_rate = 1000;
  const auto tracer = tracer_of(scene, settings);
  const double expected = std::pow(0.99, layers);
  // Through the middle of the squares run diagonals, through the rest of the x axis other edges.
  for (const float x : {-0.75f, -0.5f, -0.25f, 0.0f, 0.25f, 0.5f}) {
    for (const glm::vec3 start : {glm::vec3(x, 0, 0), glm::vec3(x, x, 0)}) {
      CHECK(double(shadow(*tracer, one_ray(start, ahead)).share[0]) ==
            Approx(expected).epsilon(1e-6));
    }
  }
}

TEST_CASE("of surfaces in one place the first is met", "[rays]") {
  DiceScene scene;
  for (int k = 0; k < 3; ++k) add_square(scene, 3);
  RaySettings settings;
  settings.dicing_rate = 30;
  const auto tracer = tracer_of(scene, settings);
  std::mt19937 random(12);
  std::uniform_real_distribution<float> x(-0.9f, 0.9f);
  for (int k = 0; k < 200; ++k) {
    const float a = x(random), b = x(random);
    const RayHits hits = closest(*tracer, one_ray({0, 0, 0}, {a, b, 3}));
    REQUIRE(hits.distance[0] < INFINITY);
    CHECK(tracer->grids()[hits.grid[0]]->surface->id == 0);
  }
}

TEST_CASE("surfaces can be kept from blocking light", "[rays]") {
  Parameter number, word, on;
  number.numbers = {0};
  word.strings = {"off"};
  on.numbers = {1};
  for (const auto& [value, blocks] : {std::pair(number, false), {word, false}, {on, true}}) {
    DiceScene scene;
    add_square(scene, 3, with_transmission(value));
    const auto tracer = tracer_of(scene);
    CHECK(look(*tracer).share[0] == (blocks ? 0.0f : 1.0f));
    CHECK((look(*tracer).distance[0] < INFINITY) == blocks);
    CHECK(closest(*tracer, one_ray({0, 0, 0}, ahead)).distance[0] < INFINITY);
  }
}

TEST_CASE("batches and threads of the build do not change a bit", "[rays]") {
  DiceScene scene;
  Quadric sphere;
  sphere.parameters = {{1, -1, 1, 360}};
  for (int k = 0; k < 5; ++k) {
    const glm::dvec3 at(k - 2, 0.3 * k, 5 - 2 * k);
    scene.add(geometry(sphere), glm::translate(glm::dmat4(1.0), at),
              with_opacity(glm::vec3(k % 2 ? 1.0f : 0.3f)));
  }
  std::mt19937 random(11);
  std::normal_distribution<float> x;
  const int count = 500;
  Rays rays(count);
  const auto point = [&] {
    const float a = x(random), b = x(random), c = x(random);
    return glm::vec3(a, b, c);
  };
  for (int k = 0; k < count; ++k) {
    const glm::vec3 origin = point();
    set_ray(rays, k, origin, point());
  }
  RaySettings one, two;
  two.threads = 2;
  const auto first = tracer_of(scene, one), second = tracer_of(scene, two);
  const RayHits all = closest(*first, rays), others = closest(*second, rays);
  const RayShadows shadows = shadow(*first, rays);
  CHECK(shadow(*second, rays).share == shadows.share);
  CHECK(std::tie(all.distance, all.grid, all.triangle, all.b1, all.b2) ==
        std::tie(others.distance, others.grid, others.triangle, others.b1, others.b2));
  for (int k = 0; k < count; ++k) {
    const Rays alone = one_ray(rays.origin[k], rays.direction[k]);
    CHECK(closest(*first, alone).distance[0] == all.distance[size_t(k)]);
    CHECK(shadow(*first, alone).share[0] == shadows.share[size_t(k)]);
  }
}

TEST_CASE("memory is counted, and grids are held", "[rays]") {
  DiceScene scene;
  add_square(scene, 3);
  add_square(scene, -3);
  RaySettings settings;
  settings.dicing_rate = 1;
  const auto tracer = tracer_of(scene, settings);
  size_t triangles = 0, grid_bytes = 0;
  for (const auto& grid : tracer->grids()) {
    triangles += 2 * size_t(grid->micropolygon_count());
    grid_bytes += grid->memory_bytes();
  }
  CHECK(tracer->memory_bytes() > grid_bytes + 12 * triangles);
  CHECK(tracer->memory_bytes() < grid_bytes + 400 * triangles + (size_t(4) << 20));
  CHECK(tracer->grids().front()->surface->id == 0);
  CHECK(tracer->grids().back()->surface->id == 1);
}

TEST_CASE("a module that is not there is named", "[rays]") {
  DiceScene scene;
  add_square(scene, 3);
  setenv("TESSERA_EMBREE_MODULE", "/nonexistent/rays.so", 1);
  CHECK_THROWS_WITH(tracer_of(scene), Catch::Contains("/nonexistent/rays.so"));
  unsetenv("TESSERA_EMBREE_MODULE");
}
