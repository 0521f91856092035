// Rays against a search through all triangles in long double.

#include <catch2/catch.hpp>

#include "tests/rays/ray_scene.h"

using namespace tessera;
using namespace tessera::test;

namespace {

glm::vec3 random_point(std::mt19937& random, float size) {
  std::uniform_real_distribution<float> x(-size, size);
  const float a = x(random), b = x(random), c = x(random);
  return {a, b, c};
}

Attributes with_opacity(float opacity) {
  Attributes attributes;
  attributes.opacity = glm::vec3(opacity);
  return attributes;
}

/// Patches here and there, in front of the camera and behind it, with keys at `times`.
void add_patches(DiceScene& scene, std::mt19937& random, int count, std::vector<float> times,
                 float opacity, float unit = 1) {
  for (int k = 0; k < count; ++k) {
    Geometry g = geometry(bicubic_mesh());
    g.key_times = times;
    const glm::vec3 centre = random_point(random, 6);
    for (size_t key = 0; key < times.size(); ++key) {
      std::vector<glm::vec3> points;
      const glm::vec3 moved = random_point(random, 1);
      for (int j = 0; j < 4; ++j) {
        for (int i = 0; i < 4; ++i) {
          const glm::vec3 corner(float(i) - 1.5f, float(j) - 1.5f, 0);
          points.push_back(unit * (centre + moved + corner + random_point(random, 0.5f)));
        }
      }
      g.P_object.push_back(points);
    }
    scene.add(std::move(g), glm::dmat4(1.0), with_opacity(opacity));
  }
}

RaySettings coarse() {
  RaySettings settings;
  settings.dicing_rate = 160;
  return settings;
}

/// A ray is left to chance if it passes that close to an edge.
bool is_clear(const std::vector<Meeting>& all) {
  return std::all_of(all.begin(), all.end(),
                     [](const Meeting& m) { return std::abs(m.margin) > 1e-4L; });
}

void check_closest(const RayTracer& tracer, std::mt19937& random, float unit = 1) {
  std::uniform_real_distribution<float> uniform(0, 1);
  const int count = 300;
  int met = 0;
  for (int k = 0; k < count; ++k) {
    const glm::vec3 origin = unit * random_point(random, 8);
    const glm::vec3 direction = random_point(random, 1) * (0.1f + 10 * uniform(random));
    const float time = uniform(random);
    const std::vector<Meeting> all = meetings(tracer, origin, direction, time);
    if (!is_clear(all)) continue;
    const RayHits hits = closest(tracer, one_ray(origin, direction, INFINITY, time));
    if (all.empty()) {
      CHECK(hits.distance[0] == INFINITY);
      continue;
    }
    ++met;
    const Meeting& first = all.front();
    CHECK(double(hits.distance[0]) == Approx(double(first.t)).epsilon(2e-5));
    CHECK(hits.grid[0] == first.grid);
    CHECK(hits.triangle[0] == first.triangle);
    CHECK(double(hits.b1[0]) == Approx(double(first.b1)).margin(2e-3));
    CHECK(double(hits.b2[0]) == Approx(double(first.b2)).margin(2e-3));
    // What lies at the far end or beyond is not met.
    const float t = hits.distance[0];
    CHECK(closest(tracer, one_ray(origin, direction, t, time)).distance[0] == INFINITY);
    CHECK(closest(tracer, one_ray(origin, direction, std::nextafter(t, INFINITY), time))
              .distance[0] == t);
  }
  CHECK(met > count / 10);
}

}  // namespace

TEST_CASE("the nearest of static triangles is met", "[rays]") {
  std::mt19937 random(1);
  DiceScene scene;
  add_patches(scene, random, 12, {0}, 1);
  check_closest(*tracer_of(scene, coarse()), random);
}

TEST_CASE("the nearest of moving triangles is met at the ray's time", "[rays]") {
  std::mt19937 random(2);
  DiceScene scene;
  add_patches(scene, random, 4, {0, 1}, 1);
  add_patches(scene, random, 4, {0, 0.25f, 1}, 1);
  add_patches(scene, random, 3, {0, 0.125f, 0.75f, 1}, 1);
  add_patches(scene, random, 3, {0}, 1);
  check_closest(*tracer_of(scene, coarse()), random);
}

TEST_CASE("rays meet what is tiny, and what is huge", "[rays]") {
  for (const float unit : {1e-15f, 1e-6f, 1e7f, 1e13f}) {
    std::mt19937 random(3);
    DiceScene scene;
    add_patches(scene, random, 8, {0}, 1, unit);
    add_patches(scene, random, 4, {0, 0.5f, 1}, 1, unit);
    check_closest(*tracer_of(scene, coarse()), random, unit);
  }
}

TEST_CASE("light passes the product of what its blockers let through", "[rays]") {
  std::mt19937 random(4);
  DiceScene scene;
  add_patches(scene, random, 10, {0, 1}, 0.25f);
  add_patches(scene, random, 10, {0}, 0.7f);
  add_patches(scene, random, 2, {0}, 1);
  add_patches(scene, random, 2, {0}, 0);
  const auto tracer = tracer_of(scene, coarse());
  std::uniform_real_distribution<float> uniform(0, 1);
  int partial = 0;
  for (int k = 0; k < 400; ++k) {
    const glm::vec3 origin = random_point(random, 8), direction = random_point(random, 6);
    const float time = uniform(random);
    const std::vector<Meeting> all = meetings(*tracer, origin, direction, time);
    if (!is_clear(all)) continue;
    long double share = 1, nearest = INFINITY;
    for (const Meeting& m : all) {
      const float opacity = tracer->grids()[m.grid]->attributes().opacity.x;
      if (m.t >= 1 || opacity == 0) continue;
      share *= 1 - static_cast<long double>(opacity);
      nearest = std::min(nearest, m.t);
    }
    partial += share > 0 && share < 1;
    const RayShadows found = shadow(*tracer, one_ray(origin, direction, 1, time));
    CHECK(double(found.share[0]) == Approx(double(share)).margin(1e-6));
    // Behind something opaque the nearest is still the nearest.
    if (nearest < INFINITY) {
      CHECK(double(found.distance[0]) == Approx(double(nearest)).epsilon(2e-5));
    } else {
      CHECK(found.distance[0] == INFINITY);
    }
  }
  CHECK(partial > 20);
}
