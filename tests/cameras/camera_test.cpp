#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "base/error.h"
#include "cameras/camera.h"

using namespace tessera;

namespace {

CameraSettings perspective(double fov_degrees, int x, int y) {
  CameraSettings s;
  s.projection = Projection::perspective;
  s.fov_degrees = fov_degrees;
  s.x_resolution = x, s.y_resolution = y;
  return s;
}

/// Raster position by the textbook formula, in long double: project, fit the shorter side of the
/// frame to [-1, 1], flip y.
glm::dvec2 raster_oracle(const CameraSettings& s, const glm::vec3& P) {
  const long double pi = std::numbers::pi_v<long double>;
  const long double scale =
      s.projection == Projection::perspective
          ? 1.0L / (std::tan((long double)(s.fov_degrees) * pi / 360.0L) * (long double)(P.z))
          : 1.0L;
  const long double aspect = (long double)(s.x_resolution) * s.pixel_aspect / s.y_resolution;
  const long double half_x = aspect >= 1 ? aspect : 1, half_y = aspect >= 1 ? 1 : 1 / aspect;
  return {double((P.x * scale + half_x) / (2 * half_x) * s.x_resolution),
          double((half_y - P.y * scale) / (2 * half_y) * s.y_resolution)};
}

}  // namespace

TEST_CASE("raster positions agree with the projection formula in long double") {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
  for (double fov : {0.001, 1.0, 45.0, 90.0, 179.0}) {
    for (auto [x, y] : {std::pair{640, 480}, std::pair{100, 300}, std::pair{1, 1}}) {
      CameraSettings s = perspective(fov, x, y);
      s.pixel_aspect = 1.25;
      const Camera camera(s);
      const float reach = float(std::tan(fov * std::numbers::pi / 360.0));
      for (int i = 0; i < 100; ++i) {
        const float z = std::exp(6.0f * unit(random));
        const glm::vec3 P(reach * z * unit(random), reach * z * unit(random), z);
        const glm::vec3 clip = camera.raster_clip_from_camera(P);
        const glm::dvec2 expected = raster_oracle(s, P);
        // Float products of positions up to the size of the raster: a few units in the last place.
        const double tolerance = 1e-6 * (x + y);
        CHECK(clip.x / clip.z == Approx(expected.x).margin(tolerance));
        CHECK(clip.y / clip.z == Approx(expected.y).margin(tolerance));
      }
    }
  }
}

TEST_CASE("an orthographic camera ignores depth") {
  CameraSettings s;
  s.x_resolution = 200, s.y_resolution = 100;
  const Camera camera(s);
  for (float z : {0.5f, 7.0f, 1e6f}) {
    const glm::vec3 clip = camera.raster_clip_from_camera({1.0f, 0.5f, z});
    CHECK(clip == glm::vec3(150.0f, 25.0f, 1.0f));
  }
}

TEST_CASE("a screen window maps to the whole raster") {
  CameraSettings s = perspective(90, 300, 200);
  s.screen_window = {-0.5, 2.5, -3, 1};
  const Camera camera(s);
  const auto raster = [&](float x, float y) {
    const glm::vec3 clip = camera.raster_clip_from_camera({2 * x, 2 * y, 2});
    return glm::vec2(clip.x / clip.z, clip.y / clip.z);
  };
  CHECK(glm::distance(raster(-0.5f, 1), glm::vec2(0, 0)) < 1e-4f);
  CHECK(glm::distance(raster(2.5f, -3), glm::vec2(300, 200)) < 1e-4f);
}

TEST_CASE("a frame aspect ratio other than the format's is fitted into it at the top left") {
  CameraSettings s = perspective(90, 640, 480);
  s.frame_aspect = 2.0;  // wider: fewer rows
  CHECK(Camera(s).frame() == PixelRect{0, 0, 640, 320});
  s.frame_aspect = 0.5;  // narrower: fewer columns
  CHECK(Camera(s).frame() == PixelRect{0, 0, 240, 480});
  s.frame_aspect = 640.0 / 480.0;
  CHECK(Camera(s).frame() == PixelRect{0, 0, 640, 480});
  s.frame_aspect = 1.7;
  CHECK(Camera(s).frame() == PixelRect{0, 0, 640, 377});  // 376.47 rows

  s.frame_aspect = 2.0;
  const Camera camera(s);
  const glm::vec3 corner = camera.raster_clip_from_camera({2, -1, 1});
  CHECK(corner.x == Approx(640));
  CHECK(corner.y == Approx(320));
}

TEST_CASE("crop windows round as the RenderMan interface prescribes") {
  CameraSettings s = perspective(90, 10, 8);
  s.crop = {0.25, 0.75, 0.0, 0.5};
  CHECK(Camera(s).crop() == PixelRect{3, 0, 8, 4});  // ceil(2.5) = 3, ceil(7.5 - 1) = 7
  SECTION("neighbouring crops tile the frame") {
    for (int parts : {2, 3, 7}) {
      long pixels = 0;
      int end = 0;
      for (int i = 0; i < parts; ++i) {
        s.crop = {double(i) / parts, double(i + 1) / parts, 0, 1};
        const PixelRect crop = Camera(s).crop();
        CHECK(crop.x0 == end);
        end = crop.x1;
        pixels += crop.pixel_count();
      }
      CHECK(pixels == 80);
    }
  }
  SECTION("a crop without pixels is refused") {
    s.crop = {0.11, 0.12, 0, 1};
    CHECK_THROWS_AS(Camera(s), Error);
  }
}

TEST_CASE("the circle of confusion matches rays traced through the lens") {
  for (Projection projection : {Projection::perspective, Projection::orthographic}) {
    CameraSettings s = perspective(40, 800, 600);
    s.projection = projection;
    s.pixel_aspect = 0.8;
    s.lens = CameraSettings::ThinLens{.f_stop = 2.0, .focal_length = 0.5, .focal_distance = 4.0};
    const Camera camera(s);
    REQUIRE(camera.lens_open());
    std::mt19937 random(2);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    for (int i = 0; i < 200; ++i) {
      const glm::dvec2 pixel(800 * unit(random), 600 * unit(random));
      const glm::dvec2 lens(unit(random), unit(random));
      const double z = 0.5 + 10.0 * std::abs(unit(random));
      const Camera::Ray ray = camera.ray_camera(pixel, lens);
      CHECK(ray.direction.z == 1.0);
      const glm::vec3 P(ray.origin + z * ray.direction);
      const glm::vec3 clip = camera.raster_clip_from_camera(P);
      const RasterClipMap& map = camera.raster_clip();
      const double x = (double(clip.x) + lens.x * double(map.coc_x(P.z))) / double(clip.z);
      const double y = (double(clip.y) + lens.y * double(map.coc_y(P.z))) / double(clip.z);
      // Cancellation between the two terms, each up to some thousand pixels near the lens.
      CHECK(x == Approx(pixel.x).margin(2e-3));
      CHECK(y == Approx(pixel.y).margin(2e-3));
    }
  }
}

TEST_CASE("a defocused point has the radius of the thin lens formula") {
  CameraSettings s = perspective(90, 200, 200);
  s.lens = CameraSettings::ThinLens{.f_stop = 4.0, .focal_length = 2.0, .focal_distance = 5.0};
  const Camera camera(s);
  // Lens radius 2 / (2 * 4) = 0.25; similar triangles give a blur of radius 0.25 |z - 5| / z in the
  // plane of focus, 5 units away, where a unit is 100 / 5 = 20 pixels.
  for (float z : {1.0f, 2.5f, 5.0f, 10.0f, 1000.0f}) {
    const double expected = 0.25 * std::abs(z - 5.0) / z * 20.0;
    CHECK(std::abs(camera.coc_raster(z).x) == Approx(expected).margin(1e-5));
    CHECK(std::abs(camera.coc_raster(z).y) == Approx(expected).margin(1e-5));
  }
  CHECK(camera.coc_raster(10.0f).x > 0);
  CHECK(camera.coc_raster(1.0f).x < 0);

  const Camera::Ray edge = camera.ray_camera({100, 100}, {0, 1});
  CHECK(edge.origin == glm::dvec3(0, -0.25, 0));  // v points down, camera y up
}

TEST_CASE("an infinite f-stop is a pinhole, and focus may lie at infinity") {
  CameraSettings s = perspective(60, 64, 64);
  const double infinity = std::numeric_limits<double>::infinity();
  s.lens = CameraSettings::ThinLens{.f_stop = infinity, .focal_length = 1, .focal_distance = 1};
  const Camera pinhole(s);
  CHECK_FALSE(pinhole.lens_open());
  CHECK(pinhole.coc_raster(3.0f) == glm::vec2(0.0f));

  s.lens = CameraSettings::ThinLens{.f_stop = 1, .focal_length = 1, .focal_distance = infinity};
  const Camera far_focus(s);
  CHECK(far_focus.coc_raster(1e9f).x == Approx(0.0f).margin(1e-6));
  CHECK(far_focus.ray_camera({1, 2}, {1, 1}).direction ==
        Camera(perspective(60, 64, 64)).ray_camera({1, 2}, {0, 0}).direction);
}

TEST_CASE("settings out of range are refused by name") {
  const auto refuses = [](auto change, const std::string& named) {
    CameraSettings s = perspective(45, 64, 48);
    s.lens = CameraSettings::ThinLens{.f_stop = 2, .focal_length = 1, .focal_distance = 3};
    CHECK_NOTHROW(Camera(s));
    change(s);
    CHECK_THROWS_WITH(Camera(s), Catch::Contains(named));
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refuses([](CameraSettings& s) { s.fov_degrees = 0; }, "field of view");
  refuses([](CameraSettings& s) { s.fov_degrees = 180; }, "field of view");
  refuses([&](CameraSettings& s) { s.fov_degrees = nan; }, "field of view");
  refuses([](CameraSettings& s) { s.x_resolution = 0; }, "x resolution");
  refuses([](CameraSettings& s) { s.y_resolution = 32769; }, "y resolution");
  refuses([](CameraSettings& s) { s.pixel_aspect = -1; }, "pixel aspect");
  refuses([&](CameraSettings& s) { s.frame_aspect = nan; }, "frame aspect");
  refuses([](CameraSettings& s) { s.screen_window = {1, 1, -1, 1}; }, "screen window");
  refuses([](CameraSettings& s) { s.crop = {0.5, 0.5, 0, 1}; }, "crop window in x");
  refuses([](CameraSettings& s) { s.crop = {0, 1, 0, 1.5}; }, "crop window in y");
  refuses([](CameraSettings& s) { s.near_clip = 5, s.far_clip = 5; }, "near clipping");
  refuses([](CameraSettings& s) { s.lens->f_stop = 0; }, "f-stop");
  refuses([](CameraSettings& s) { s.lens->focal_length = -1; }, "focal length");
  refuses([&](CameraSettings& s) { s.lens->focal_distance = nan; }, "focal distance");
  refuses([](CameraSettings& s) { s.shutter_open = 1; }, "shutter");
  refuses([](CameraSettings& s) { s.lens_profile = "ring"; }, "disc, smooth or polygon");
  refuses([](CameraSettings& s) { s.shutter_profile = "slit"; }, "box, trapezoid or gaussian");
  refuses([](CameraSettings& s) { s.lens_profile = "polygon", s.lens_blades = 2; }, "blades");
}
