/// Images whose coverage follows from a formula.

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

#include "tests/hide/hide_fixture.h"

using namespace tessera;

namespace {

constexpr double pi = std::numbers::pi;

/// A camera whose raster is the x-y plane at any depth, one pixel a unit, y up from the bottom.
CameraSettings orthographic_pixels(int width, int height) {
  CameraSettings s;
  s.projection = Projection::orthographic;
  s.x_resolution = width, s.y_resolution = height;
  s.screen_window = {{0.0, double(width), 0.0, double(height)}};
  s.near_clip = 0.1;
  return s;
}

std::vector<double> pixel_coverage(const TestBucket& bucket, const FragmentList& list) {
  std::vector<double> result(size_t(bucket.samples.rect.pixel_count()), 0.0);
  for (size_t i = 0; i < list.size(); ++i)
    result[list.sample[i] / size_t(bucket.samples.samples_per_pixel)] += list.weight[i];
  return result;
}

}  // namespace

TEST_CASE("A disc of micropolygons covers the area of its polygon") {
  constexpr int n = 96;
  constexpr double radius = 9.3;
  TestBucket bucket(orthographic_pixels(24, 24));
  bucket.add(make_grid(n, 4, {0}, [&](float u, float v, int) {
    const double angle = 2 * pi * u;
    return glm::vec3(12.1 + radius * v * std::cos(angle), 11.7 + radius * v * std::sin(angle), 2.0);
  }));
  bucket.make_samples({0, 0, 24, 24}, 256, 1);
  const double expected = 0.5 * n * radius * radius * std::sin(2 * pi / n);
  for (const char* hider : {"bbox", "shear"}) {
    double area = 0;
    for (const double c : pixel_coverage(bucket, bucket.hide(hider))) area += c;
    // About 60 border pixels, each with a stratified error of about 256^(-3/4) = 0.016, root sum:
    // 0.12.
    REQUIRE(area == Approx(expected).margin(0.4));
  }
}

TEST_CASE("A moving edge blurs to a ramp") {
  // The edge at x = 4 + 8 t: pixel i is covered for the share of time in which the edge is past it.
  TestBucket bucket(orthographic_pixels(16, 4));
  bucket.add(make_grid(3, 2, {0, 1}, [](float u, float v, int key) {
    return glm::vec3(4 + 8 * key - 20 * (1 - u), -1 + 6 * v, 2);
  }));
  bucket.make_samples({0, 0, 16, 4}, 1024, 2);
  for (const char* hider : {"bbox", "shear"}) {
    const auto coverage = pixel_coverage(bucket, bucket.hide(hider));
    for (int i = 0; i < 16; ++i) {
      // Mean over the pixel of the share of t with 4 + 8 t > x: 1 - (x - 4) / 8, clamped.
      const double expected = std::clamp(1 - (i + 0.5 - 4) / 8, 0.0, 1.0);
      REQUIRE(coverage[size_t(16 + i)] == Approx(expected).margin(0.01));
    }
  }
}

TEST_CASE("Three keys: out and back") {
  // The square [4, 6] goes to [10, 12] at t = 1/4 and back at t = 1; pixel 8 sees it when
  // 6 t' in (2, 4) + part, on both ways: 2 units long at speed 24, then at speed 8.
  TestBucket bucket(orthographic_pixels(16, 4));
  bucket.add(make_grid(1, 1, {0, 0.25f, 1}, [](float u, float v, int key) {
    return glm::vec3((key == 1 ? 10 : 4) + 2 * u, -1 + 6 * v, 2);
  }));
  bucket.make_samples({0, 0, 16, 4}, 1024, 2);
  for (const char* hider : {"bbox", "shear"}) {
    const auto coverage = pixel_coverage(bucket, bucket.hide(hider));
    // A point is under the square while it travels its own length: 2 / 24 + 2 / 8 of the time.
    for (const int x : {7, 8})
      REQUIRE(coverage[size_t(16 + x)] == Approx(2.0 / 24 + 2.0 / 8).margin(0.01));
  }
}

TEST_CASE("A point out of focus is a disc of the circle of confusion") {
  CameraSettings settings = perspective_settings(64, 64, 90);
  settings.lens = CameraSettings::ThinLens{1.0, 1.0, 4.0};  // radius 0.5, focus at 4
  TestBucket bucket(settings);
  const double z = 2.0, size = 0.1;
  bucket.add(make_grid(1, 1, {0}, [&](float u, float v, int) {
    return glm::vec3(size * (u - 0.5), size * (v - 0.5), z);
  }));
  bucket.make_samples({0, 0, 64, 64}, 256, 4);
  // 1.6 x 1.6 pixels of 256 samples are 655 hits, known to 4 percent.
  // 32 pixels a unit at depth 1; a lens of radius R sees depth z spread over R |z / f - 1| / z of
  // them.
  const double radius = 32 * 0.5 * std::abs(z / 4 - 1) / z;
  REQUIRE(std::abs(bucket.camera.coc_raster(float(z)).x) == Approx(radius));
  for (const char* hider : {"bbox", "shear"}) {
    const FragmentList list = bucket.hide(hider);
    double weight = 0, second_moment = 0, farthest = 0;
    for (size_t i = 0; i < list.size(); ++i) {
      const double x = bucket.samples.x[list.sample[i]] - 32,
                   y = bucket.samples.y[list.sample[i]] - 32;
      weight += list.weight[i], second_moment += list.weight[i] * (x * x + y * y);
      farthest = std::max(farthest, std::hypot(x, y));
    }
    // All of the quad's (32 size / z)^2 pixels of area arrive, spread over a uniform disc, whose
    // mean squared distance is radius^2 / 2, plus the quad's own side^2 / 6.
    const double side = 32 * size / z;
    REQUIRE(weight == Approx(side * side).epsilon(0.1));
    REQUIRE(second_moment / weight == Approx(radius * radius / 2 + side * side / 6).epsilon(0.1));
    REQUIRE(farthest < radius + side);
    REQUIRE(farthest > radius - side);
  }
}

TEST_CASE("One-sided surfaces show the side of their normal") {
  for (const bool orthographic : {false, true})
    for (const float normal_sign : {1.0f, -1.0f})
      for (const bool mirrored : {false, true}) {
        CameraSettings settings =
            orthographic ? orthographic_pixels(8, 8) : perspective_settings(8, 8);
        TestBucket bucket(settings);
        bucket.add(make_grid(2, 2, {0}, [&](float u, float v, int) {
          const float x = mirrored ? 1 - u : u;
          return orthographic ? glm::vec3(8 * x, 8 * v, 2) : glm::vec3(4 * x - 2, 4 * v - 2, 2);
        }));
        Grid& grid = *bucket.grids[0];
        grid.one_sided = true, grid.normal_sign = normal_sign;
        bucket.make_samples({0, 0, 8, 8}, 4, 1);
        const glm::dvec3 a = vertex_at(grid, 0, 0), b = vertex_at(grid, 1, 0),
                         d = vertex_at(grid, 4, 0);
        const glm::dvec3 normal = double(normal_sign) * glm::cross(b - a, d - a);
        const glm::dvec3 view = orthographic ? glm::dvec3(0, 0, 1) : a;
        const bool faces_camera = glm::dot(normal, view) < 0;
        for (const char* hider : {"bbox", "shear"})
          REQUIRE((bucket.hide(hider).size() > 0) == faces_camera);
      }
}

TEST_CASE("The clipping planes cut surfaces") {
  // The plane z = x / 4 under an orthographic camera, seen for z in [1, 3]: x in [4, 12].
  CameraSettings settings = orthographic_pixels(16, 4);
  settings.near_clip = 1, settings.far_clip = 3;
  TestBucket bucket(settings);
  bucket.add(
      make_grid(5, 1, {0}, [](float u, float v, int) { return glm::vec3(16 * u, 4 * v, 4 * u); }));
  bucket.make_samples({0, 0, 16, 4}, 16, 1);
  for (const char* hider : {"bbox", "shear"}) {
    const auto coverage = pixel_coverage(bucket, bucket.hide(hider));
    for (int x = 0; x < 16; ++x) REQUIRE(coverage[size_t(x)] == (x >= 4 && x < 12 ? 1.0 : 0.0));
  }
}

TEST_CASE("At equal depth the earlier grid is in front") {
  for (const bool motion : {false, true}) {
    TestBucket bucket(orthographic_pixels(8, 8));
    for (int g = 0; g < 3; ++g)
      bucket.add(make_grid(2, 2, motion ? std::vector<float>{0, 1} : std::vector<float>{0},
                           [](float u, float v, int) { return glm::vec3(8 * u, 8 * v, 2); }));
    bucket.make_samples({0, 0, 8, 8}, 16, 1);
    for (const char* hider : {"bbox", "shear"}) {
      const FragmentList list = bucket.hide(hider);
      REQUIRE(list.size() == bucket.samples.size());
      for (const uint32_t g : list.grid) REQUIRE(g == 0);
    }
  }
}
