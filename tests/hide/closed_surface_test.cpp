/// A closed surface in every kind of trouble at once: moving, out of focus, in front of the eye,
/// through the plane of the eye, and around it. A sight line that starts outside crosses it an even
/// number of times, one that starts inside an odd number, however the surface is rounded, if no
/// edge or vertex of it is missed or seen twice.

#include <catch2/catch.hpp>

#include <cmath>
#include <string_view>

#include "tests/hide/ray_oracle.h"

using namespace tessera;

namespace {

/// Point (x, y, z) of the lattice on the surface of a cube, -n to n, pushed onto a rough sphere of
/// about the radius. A function of the three numbers alone, so that grids share their vertices bit
/// for bit.
glm::vec3 rough_sphere(glm::ivec3 at, uint32_t seed, float radius, float roughness) {
  std::seed_seq sequence{seed, uint32_t(at.x + 100), uint32_t(at.y + 100), uint32_t(at.z + 100)};
  std::mt19937 random(sequence);
  const float bump = std::uniform_real_distribution<float>(1 - roughness, 1)(random);
  return radius * bump * glm::normalize(glm::vec3(at));
}

struct Sphere {
  float radius = 1, roughness = 0.1f;
  std::vector<glm::vec3> centres;  ///< [key]
};

/// Six grids of n x n micropolygons, one for each side of the cube.
void add_sphere(TestBucket& bucket, const Sphere& sphere, int n, uint32_t seed) {
  std::vector<float> times{0.0f};
  for (size_t k = 1; k < sphere.centres.size(); ++k)
    times.push_back(float(k) / float(sphere.centres.size() - 1));
  for (int side = 0; side < 6; ++side)
    bucket.add(make_grid(n, n, times, [&](float u, float v, int key) {
      const int i = 2 * int(std::lround(u * float(n))) - n;
      const int j = 2 * int(std::lround(v * float(n))) - n, k = side % 2 ? n : -n;
      const glm::ivec3 at = side < 2   ? glm::ivec3(k, i, j)
                            : side < 4 ? glm::ivec3(j, k, i)
                                       : glm::ivec3(i, j, k);
      return sphere.centres[size_t(key)] +
             rough_sphere(at, seed + uint32_t(key), sphere.radius, sphere.roughness);
    }));
  bucket.opaque.assign(bucket.grids.size(), false);  // so that all layers are reported
}

TestBucket sphere_bucket(const Sphere& sphere, bool lens, uint32_t seed) {
  CameraSettings settings = perspective_settings(24, 24, 120);
  settings.near_clip = 0;
  if (lens) settings.lens = CameraSettings::ThinLens{0.5, 0.25, 1.5};
  TestBucket bucket(settings);
  add_sphere(bucket, sphere, 3, seed);
  bucket.make_samples({0, 0, 24, 24}, 4, seed);
  return bucket;
}

/// Every sample has as many layers as rays find, and where rounding decides, still a number of the
/// right parity.
void require_layers(const TestBucket& bucket, size_t parity) {
  std::vector<RayHit> expected;
  for (size_t s = 0; s < bucket.samples.size(); ++s) expected.push_back(trace(bucket, s));
  for (const HiderDefinition& definition : hider_registry()) {
    const std::string_view name = definition.name;
    // Those that sample anywhere and share the common coverage test.
    if (name != "bbox" && name != "auto" && name != "shear" && name != "dual" && name != "pixar")
      continue;
    const FragmentList list = bucket.hide(definition.name);
    size_t hits = 0;
    for (size_t s = 0; s < bucket.samples.size(); ++s) {
      const size_t layers = list.first_of_sample[s + 1] - list.first_of_sample[s];
      INFO(name << " sample " << s << " at " << bucket.samples.x[s] << " " << bucket.samples.y[s]
                << ": " << layers << " layers, rays find " << expected[s].layers);
      REQUIRE(layers % 2 == parity);
      if (!expected[s].doubtful) REQUIRE(layers == size_t(expected[s].layers));
      hits += layers > 0;
    }
    REQUIRE(hits > bucket.samples.size() / 50);
  }
}

}  // namespace

TEST_CASE("A closed surface is entered and left equally often") {
  for (const bool lens : {false, true}) {
    INFO("lens " << lens);
    uint32_t seed = lens ? 50 : 0;
    const auto run = [&](const char* name, const Sphere& sphere, size_t parity) {
      INFO(name);
      require_layers(sphere_bucket(sphere, lens, ++seed), parity);
    };
    const glm::vec3 ahead(0.1f, -0.2f, 2.5f);
    run("still", {1, 0.3f, {ahead}}, 0);
    run("moving", {1, 0.3f, {ahead, ahead + glm::vec3(1.5f, 0.5f, 1)}}, 0);
    run("growing rougher over three keys", {1, 0.6f, {ahead, ahead, ahead}}, 0);
    run("through the plane of the eye, beside it",
        {1, 0.2f, {{-1.7f, 0.3f, 1.5f}, {-1.6f, 0.2f, -0.8f}}}, 0);
    run("there and back, over the eye",
        {1, 0.2f, {{0, -1.6f, 1}, {0.2f, -1.6f, -1}, {0, -1.6f, 1}}}, 0);
    run("around the eye", {1, 0.2f, {{0, 0, 0.2f}}}, 1);
    run("around the eye and moving", {2, 0.3f, {{-0.5f, 0, 0.5f}, {0.5f, 0.2f, -0.5f}}}, 1);
  }
}
