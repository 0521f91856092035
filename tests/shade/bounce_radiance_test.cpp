#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <thread>

#include "shade/bindings.h"
#include "shade/bounce_radiance.h"
#include "tests/shade/ray_fixtures.h"

using namespace tessera;
using namespace tessera::test;

TEST_CASE("the two sides of a surface are lit apart") {
  TestScene test;
  test.add_light(call("pointlight", {triple("from", ValueType::point, {2, 0, -1})}));
  const Surface& surface = test.add_surface("plastic", {number("Ks", 1e6f)});
  const auto bindings = test.bind();
  const BruteTracer tracer({make_wall(surface, 8, 1.0f, 2.0f)});
  const BounceRadiance bounce(*bindings, tracer);
  ShadeCounters counters;
  Rays rays(3);
  for (int i = 0; i < 3; ++i) {
    rays.origin.set(i, {i == 0 ? 1.0f : -1.0f, 0.1f, -0.9f});
    rays.direction.set(i, {i == 0 ? -2.0f : 2.0f, 0, 0});  // of any length
    rays.far[size_t(i)] = 10.0f;
  }
  rays.direction.set(2, {0, 0, -1});  // past it
  RayHits hits;
  tracer.closest(rays, hits);
  Vec3Array met;
  bounce.radiance(rays, hits, met, counters);
  // Light of 1 at distance about 2, plastic's Kd of 1/2; no highlight however strong.
  // Vertices half a unit apart are somewhat darker than the point between them.
  CHECK(met[0].x == Approx(0.5 / 4).epsilon(0.05));
  CHECK(met[1] == glm::vec3(0.0f));
  CHECK(met[2] == glm::vec3(0.0f));
  CHECK(counters.bounce_points_shaded == 2 * 25);  // every second vertex of 9 x 9
}

TEST_CASE("vertices on the rim of a grid are shaded a little inside") {
  // 1/32 of two micropolygons of 1/2, along both sides of the corner.
  const double inside = 1.0 / 32;
  TestScene test;
  test.add_light(call("pointlight", {triple("from", ValueType::point, {1, 1, 2.99f})}));
  const Surface& surface = test.add_surface("matte");
  const auto bindings = test.bind();
  const auto grid = make_square(surface, 4, 3.0f);
  set_normals(*grid, [](float, float) { return glm::vec3(0, 0, -1); });
  const BruteTracer tracer({grid});
  const BounceRadiance bounce(*bindings, tracer);
  Rays rays(1);
  rays.origin.set(0, {1, 1, 0}), rays.direction.set(0, {0, 0, 1});
  RayHits hits;
  hits.distance = {3.0f}, hits.grid = {0}, hits.triangle = {2 * 15}, hits.b1 = {0}, hits.b2 = {1};
  Vec3Array met;
  ShadeCounters counters;
  bounce.radiance(rays, hits, met, counters);
  const double height = 0.01, distance = std::sqrt(2 * inside * inside + height * height);
  CHECK(double(met[0].x) == Approx(height / std::pow(distance, 3)).epsilon(1e-3));
}

TEST_CASE("between shaded vertices radiance is linear, whatever the size of the grid") {
  // Light that grows along u and v: the mean of four corners, weighted by place, has no error.
  for (const int n : {1, 2, 3, 5}) {
    Attributes attributes;
    attributes.surface = call("matte");
    TestScene test;
    test.add_light(call("ambientlight"));
    const Surface& surface = test.add_surface(attributes);
    const auto grid = make_square(surface, n, 2.0f);
    const auto source = add_primvar(*grid, "Cs", ValueType::color, [](float u, float v) {
      return std::vector<float>{u, v, 0.25f + 0.5f * u + 0.25f * v};
    });
    const auto bindings = test.bind();
    const BruteTracer tracer({grid});
    const BounceRadiance bounce(*bindings, tracer);
    const float step = 1.0f / float(n);
    ShadeCounters counters;
    for (int k = 0; k < n * n; ++k) {
      Rays rays(1);
      rays.direction.set(0, {0, 0, 1});
      RayHits hits;
      hits.distance = {2.0f}, hits.grid = {0}, hits.triangle = {uint32_t(2 * k)};
      hits.b1 = {0.25f}, hits.b2 = {0.5f};  // of the corners at (0, 0), (1, 0), (1, 1)
      Vec3Array met;
      bounce.radiance(rays, hits, met, counters);
      const float u = (float(k % n) + 0.75f) * step, v = (float(k / n) + 0.5f) * step;
      CAPTURE(n, k);
      CHECK(met[0].x == Approx(u));
      CHECK(met[0].y == Approx(v));
      CHECK(met[0].z == Approx(0.25f + 0.5f * u + 0.25f * v));
    }
    const int shaded = n / 2 + n % 2 + 1;
    CHECK(counters.bounce_points_shaded == uint64_t(shaded * shaded));
  }
}

TEST_CASE("whoever asks first, surfaces are shaded once and look the same") {
  TestScene test;
  test.add_light(call("pointlight", {triple("from", ValueType::point, {0.3f, 0.2f, 4})}));
  const Surface& surface = test.add_surface("marble");
  const auto bindings = test.bind();
  std::vector<std::shared_ptr<const Grid>> grids;
  for (uint32_t face = 0; face < 8; ++face)
    grids.push_back(make_ball(surface, {0, 0, 4}, 1.0f + 0.01f * float(face), 8, 6));
  const BruteTracer tracer(grids);
  Rays rays(64);
  RayHits hits;
  hits.distance.assign(64, 1.0f), hits.b1.assign(64, 0.25f), hits.b2.assign(64, 0.5f);
  for (int i = 0; i < 64; ++i) {
    rays.direction.set(i, {i % 3 == 0 ? 1.0f : -1.0f, 0.5f, 0.25f});
    hits.grid.push_back(uint32_t(i) % 8), hits.triangle.push_back(uint32_t(i) + 16);
  }
  const BounceRadiance alone(*bindings, tracer), shared(*bindings, tracer);
  Vec3Array expected;
  ShadeCounters once;
  alone.radiance(rays, hits, expected, once);
  std::array<Vec3Array, 8> met;
  std::array<ShadeCounters, 8> counters;
  std::vector<std::thread> threads;
  for (size_t k = 0; k < 8; ++k)
    threads.emplace_back([&, k] { shared.radiance(rays, hits, met[k], counters[k]); });
  for (std::thread& thread : threads) thread.join();
  uint64_t points = 0;
  for (size_t k = 0; k < 8; ++k) {
    points += counters[k].bounce_points_shaded;
    for (int i = 0; i < 64; ++i) REQUIRE(met[k][i] == expected[i]);
  }
  CHECK(points == once.bounce_points_shaded);
  CHECK(points > 0);
}

TEST_CASE("where a shader fails what bounces is black, and counted") {
  TestScene test;
  test.add_light(call("ambientlight", {number("intensity", INFINITY),
                                       triple("lightcolor", ValueType::color, {0, 1, 1})}));
  const Surface& surface = test.add_surface("matte");
  const auto bindings = test.bind();
  const BruteTracer tracer({make_square(surface, 2, 2.0f)});
  const BounceRadiance bounce(*bindings, tracer);
  Rays rays(1);
  rays.origin.set(0, {0.1f, 0.2f, 1}), rays.direction.set(0, {0, 0, 1}), rays.far[0] = 10.0f;
  RayHits hits;
  tracer.closest(rays, hits);
  REQUIRE(hits.distance[0] == 1.0f);
  Vec3Array met;
  ShadeCounters counters;
  bounce.radiance(rays, hits, met, counters);
  CHECK(met[0] == glm::vec3(0.0f));
  CHECK(counters.nonfinite_dropped == 4);
  CHECK(test.warned("not finite"));
}
