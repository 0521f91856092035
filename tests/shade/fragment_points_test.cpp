// Where on their surfaces fragments are asked about light, at shutter open and at samples' times.

#include <catch2/catch.hpp>

#include <cmath>

#include "shade/fragment_points.h"
#include "tests/shade/ray_fixtures.h"

using namespace tessera;
using namespace tessera::test;

TEST_CASE("points are carried along with surfaces that turn") {
  TestScene test;
  const Surface& surface = test.add_surface("matte");
  test.bind();
  // A cap of a ball that turns by 1 radian about its centre, 4 before the eye, with 64 keys.
  const glm::dvec3 centre(0, 0, 4);
  const auto normal = [](float u, float v) {
    const float x = 0.5f * (u - 0.5f), y = 0.5f * (v - 0.5f);
    return glm::vec3(x, y, -std::sqrt(1.0f - x * x - y * y));
  };
  const auto turned = [](const glm::dvec3& p, double t) {
    return glm::dvec3(p.x * std::cos(t) + p.z * std::sin(t), p.y,
                      -p.x * std::sin(t) + p.z * std::cos(t));
  };
  auto grid =
      make_grid(surface, 4, 4, [&](float u, float v) { return glm::vec3(centre) + normal(u, v); });
  set_normals(*grid, normal);
  for (int key = 1; key <= 64; ++key) {
    add_key(*grid, float(key) / 64.0f, [&](const glm::vec3& P) {
      return glm::vec3(centre + turned(glm::dvec3(P) - centre, key / 64.0));
    });
  }
  TestBucket bucket(32);
  bucket.grids = {grid};
  std::vector<uint32_t> all;
  for (uint32_t k = 0; k < 32; ++k) {
    bucket.add(0, k, 0.3f, 0.4f, 3.0f);
    bucket.finish_sample();
    bucket.samples.t.push_back(float(k) / 31.0f);
    all.push_back(k);
  }
  const ShadeInput input = bucket.input();
  const FragmentPoints open(input, all, PointTime::shutter_open, *test.camera, false);
  const FragmentPoints then(input, all, PointTime::of_sample, *test.camera, true);
  CHECK(open.points().time == nullptr);
  CHECK(then.points().dPdx.x != nullptr);
  for (int k = 0; k < 32; ++k) {
    const double t = double(bucket.samples.t[size_t(k)]);
    const glm::dvec3 P = centre + turned(glm::dvec3(open.points().P[k]) - centre, t);
    // Keys 1/64 apart are joined by chords, up to 1 - cos(1/128) = 3.1e-5 inside.
    CHECK(glm::length(glm::dvec3(then.points().P[k]) - P) < 4e-5);
    const glm::dvec3 N = turned(glm::dvec3(open.points().N[k]), t);
    // Towards the eye all the time, for the triangle turns by less than a right angle.
    CHECK(glm::length(glm::dvec3(then.points().N[k]) - N) < 1e-4);
    CHECK(then.points().time[k] == bucket.samples.t[size_t(k)]);
    CHECK(then.points().surface[k] == surface.id);
    // On the ball, where the triangle is not: its corners are 1/8 apart.
    CHECK(glm::length(glm::dvec3(open.points().P[k]) - centre) == Approx(1.0).margin(2e-4));
  }
}

TEST_CASE("normals of surfaces seen from behind point to the eye, and lost ones harm nobody") {
  TestScene test;
  const Surface& surface = test.add_surface("matte");
  test.bind();
  auto away = make_square(surface, 1, 3.0f), flat = make_square(surface, 1, 3.0f);
  set_normals(*away, [](float, float) { return glm::vec3(0, 0, 1); });
  for (float& p : flat->P_camera) p = 1.0f;
  for (float& n : flat->N_camera) n = 0.0f;
  add_key(*flat, 1.0f, [](const glm::vec3& P) { return P; });
  TestBucket bucket(2);
  bucket.grids = {away, flat};
  bucket.samples.t = {0.5f, 0.5f};
  bucket.add(0, 0, 0.25f, 0.25f, 3.0f);
  bucket.finish_sample();
  bucket.add(1, 1, 0.25f, 0.25f, 1.0f);
  bucket.finish_sample();
  const std::vector<uint32_t> all{0, 1};
  const FragmentPoints points(bucket.input(), all, PointTime::of_sample, *test.camera, false);
  CHECK(points.points().N[0] == glm::vec3(0, 0, -1));
  CHECK(points.points().N[1] == glm::vec3(0, 0, 0));
  CHECK(points.points().P[1] == glm::vec3(1, 1, 1));
}
