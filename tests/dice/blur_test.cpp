// Micropolygons grow with the blur they receive, never with more than that, and not at all where a
// part is sharp.

#include <cmath>
#include <random>

#include <catch2/catch.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "dice/dice_rate.h"
#include "tests/dice/dice_scene.h"

namespace tessera::test {
namespace {

constexpr int pixels = 200;
// fov 60 degrees over 200 pixels: a unit at distance 1 spans this many.
const double scale = 0.5 * pixels / std::tan(3.14159265358979 / 6);

struct BlurScene : DiceScene {
  BlurScene() : DiceScene(pixels, pixels) {
    scene.camera.shutter_open = 0;
    scene.camera.shutter_close = 1;
  }
  void focus(double f_stop, double focal_length, double distance) {
    scene.camera.lens = CameraSettings::ThinLens{f_stop, focal_length, distance};
  }
  RasterProjection projection() const { return {Camera(scene.camera), settings.crop}; }
};

using Points = std::vector<glm::vec3>;

LeastBlur blur_of(const BlurScene& s, const std::vector<Points>& keys,
                  const std::vector<float>& times) {
  LeastBlur blur;
  for (size_t k = 0; k < keys.size(); ++k) blur.add_key(s.projection(), times[k], keys[k]);
  return blur;
}

Points moved(const Points& points, const glm::dmat4& by) {
  Points result;
  for (const glm::vec3& p : points) result.emplace_back(by * glm::dvec4(p, 1));
  return result;
}

const Points square{{-1, -1, 5}, {1, -1, 5}, {-1, 1, 5}, {1, 1, 5}};

glm::dmat4 shift(double x, double y, double z) {
  return glm::translate(glm::dmat4(1), glm::dvec3(x, y, z));
}

TEST_CASE("motion blur is the length of the path where all points move alike", "[dice][blur]") {
  const BlurScene s;
  const double length = 0.5 * scale / 5;
  CHECK(blur_of(s, {square, moved(square, shift(0.5, 0, 0))}, {0, 1}).motion_pixels() ==
        Approx(length).epsilon(1e-4));
  CHECK(blur_of(s, {square, moved(square, shift(0.3, -0.4, 0))}, {0, 1}).motion_pixels() ==
        Approx(length).epsilon(1e-4));
  CHECK(blur_of(s, {square}, {0}).motion_pixels() == 0);
}

TEST_CASE("what rests for a part of the shutter, or stays where it is, has no motion blur",
          "[dice][blur]") {
  const BlurScene s;
  const Points there = moved(square, shift(0.5, 0, 0));
  CHECK(blur_of(s, {square, there, there}, {0, 0.5f, 1}).motion_pixels() == 0);
  CHECK(blur_of(s, {square, square, there}, {0, 0.9f, 1}).motion_pixels() == 0);
  // Slow for the first half: as if it moved so all the time.
  CHECK(
      blur_of(s, {square, moved(square, shift(0.1, 0, 0)), there}, {0, 0.5f, 1}).motion_pixels() ==
      Approx(0.2 * scale / 5).epsilon(1e-4));
  // A tremble of a pixel and a half in many keys is a long way to go, but not far.
  std::vector<Points> keys;
  std::vector<float> times;
  for (int k = 0; k <= 32; ++k) {
    keys.push_back(moved(square, shift(k % 2 * 0.05, 0, 0)));
    times.push_back(float(k) / 32);
  }
  CHECK(blur_of(s, keys, times).motion_pixels() == Approx(0.05 * scale / 5).epsilon(1e-3));
  // About its own middle: the middle stays. And towards the camera, straight at it.
  const glm::dmat4 turn =
      shift(0, 0, 5) * glm::rotate(glm::dmat4(1), 0.4, glm::dvec3(0, 0, 1)) * shift(0, 0, -5);
  CHECK(blur_of(s, {square, moved(square, turn)}, {0, 1}).motion_pixels() == 0);
  CHECK(blur_of(s, {square, moved(square, shift(0, 0, -2))}, {0, 1}).motion_pixels() == 0);
}

TEST_CASE("nothing is known of blur at the camera plane", "[dice][blur]") {
  BlurScene s;
  s.focus(2, 0.5, 8);
  for (const double z : {-5.0, -5.5, -9.0}) {
    const LeastBlur blur =
        blur_of(s, {moved(square, shift(0, 0, z)), moved(square, shift(2, 0, z))}, {0, 1});
    CHECK(blur.motion_pixels() == 0);
    CHECK(blur.focus_pixels() == 0);
  }
}

TEST_CASE("focus blur is the diameter of the least circle of confusion", "[dice][blur]") {
  BlurScene s;
  const double f = 0.5, distance = 8, aperture = f / 2.8;
  s.focus(2.8, f, distance);
  // A thin lens focused at `distance`: a point at z is seen from the rim of the lens, in the plane
  // of focus, displaced by (aperture / 2) |z - distance| / z.
  const auto diameter = [&](double z) {
    return aperture * std::abs(z - distance) / z * scale / distance;
  };
  CHECK(blur_of(s, {square}, {0}).focus_pixels() == Approx(diameter(5)).epsilon(1e-3));
  const Points slope{{-1, 0, 4}, {1, 0, 4}, {-1, 0, 6}, {1, 0, 6}};
  CHECK(blur_of(s, {slope}, {0}).focus_pixels() == Approx(diameter(6)).epsilon(1e-3));
  // Some of it in focus: between the samples, or between the keys.
  CHECK(blur_of(s, {moved(slope, shift(0, 0, 3))}, {0}).focus_pixels() == 0);
  CHECK(blur_of(s, {square, moved(square, shift(0, 0, 5))}, {0, 1}).focus_pixels() == 0);
}

// Of a quadrilateral, corner 0 at the origin of the parameters, 1 along u, 2 along v.
glm::dvec3 bilinear(const Points& p, double u, double v) {
  return (1 - v) * ((1 - u) * glm::dvec3(p[0]) + u * glm::dvec3(p[1])) +
         v * ((1 - u) * glm::dvec3(p[2]) + u * glm::dvec3(p[3]));
}

TEST_CASE("least motion is no more than what points between the samples move", "[dice][blur]") {
  const BlurScene s;
  std::mt19937 random{7};
  std::uniform_real_distribution<double> uniform(-1, 1);
  int moving = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const glm::dvec3 axis(uniform(random), uniform(random), uniform(random));
    const glm::dmat4 by = shift(uniform(random), uniform(random), 5 + 0.5 * uniform(random)) *
                          glm::rotate(glm::dmat4(1), 0.5 * uniform(random), axis) * shift(0, 0, -5);
    const Points there = moved(square, by);
    // As densely as dicing samples a bilinear patch.
    std::vector<Points> samples(2);
    for (int k = 0; k < 25; ++k) {
      samples[0].emplace_back(bilinear(square, k % 5 / 4.0, k / 5 / 4.0));
      samples[1].emplace_back(bilinear(there, k % 5 / 4.0, k / 5 / 4.0));
    }
    const float claimed = blur_of(s, samples, {0, 1}).motion_pixels();
    moving += claimed > 5;
    double least = 1e9;
    for (int j = 0; j <= 20; ++j) {
      for (int i = 0; i <= 20; ++i) {
        const auto at = [&](const Points& p) {
          const glm::dvec3 q = bilinear(p, i / 20.0, j / 20.0);
          return scale * glm::dvec2(q.x, q.y) / q.z;
        };
        least = std::min(least, glm::distance(at(square), at(there)));
      }
    }
    INFO("trial " << trial);
    // Perspective weighs the points between two samples a little differently at the two times.
    CHECK(claimed <= 1.02 * least + 0.01);
  }
  CHECK(moving > 100);
}

Geometry flat_square() {
  PatchMesh mesh;
  mesh.u_vertices = mesh.v_vertices = 2;
  return geometry(mesh, {{-1, -1, 0}, {1, -1, 0}, {-1, 1, 0}, {1, 1, 0}});
}

uint64_t micropolygons_of_square(double motion_pixels, float factor, float rate = 1) {
  BlurScene s;
  Attributes attributes;
  attributes.shading_rate = rate;
  attributes.motion_factor = factor;
  Surface& surface = s.add(flat_square(), glm::dmat4(1), attributes);
  surface.world_from_object =
      MovingTransform({0.0f, 1.0f}, {shift(0, 0, 4), shift(motion_pixels / scale * 4, 0, 4)});
  DiceCounters counters;
  s.all_grids(&counters);
  return counters.micropolygons;
}

TEST_CASE("micropolygons grow with factor times blur over 16 pixels", "[dice][blur]") {
  const double full = double(micropolygons_of_square(0, 0));
  const auto growth = [full](double motion_pixels, float factor) {
    return full / double(micropolygons_of_square(motion_pixels, factor));
  };
  CHECK(growth(60, 0) == Approx(1).epsilon(0.03));
  CHECK(growth(15, 1) == Approx(1).epsilon(0.03));
  CHECK(growth(48, 1) == Approx(3).epsilon(0.15));
  CHECK(growth(48, 2) == Approx(6).epsilon(0.15));
  // Never beyond a quarter of the blur, whatever the factor.
  CHECK(growth(16, 1e4f) == Approx(16).epsilon(0.15));
  CHECK(growth(3, 1e4f) == Approx(1).epsilon(0.03));
  // In proportion at other rates, too.
  CHECK(double(micropolygons_of_square(0, 0, 4)) / double(micropolygons_of_square(48, 1, 4)) ==
        Approx(3).epsilon(0.15));
}

TEST_CASE("keys blur nothing while the shutter is closed, nor what has no factor", "[dice][blur]") {
  for (const bool open : {false, true}) {
    BlurScene s;
    s.scene.camera.shutter_close = open ? 1 : 0;
    s.settings.motion_factor = 1;
    Surface& surface = s.add(flat_square());
    surface.world_from_object = MovingTransform({0.0f, 1.0f}, {shift(0, 0, 4), shift(1, 0, 4)});
    DiceCounters by_default, told_not_to;
    s.all_grids(&by_default);
    Attributes attributes;
    attributes.motion_factor = 0;
    surface.attributes = std::make_shared<Attributes>(attributes);
    s.all_grids(&told_not_to);
    CHECK((by_default.micropolygons < told_not_to.micropolygons / 2) == open);
  }
}

TEST_CASE("a blurred sphere keeps its outline", "[dice][blur]") {
  for (const double distance : {6.0, 30.0}) {
    double sag[2] = {};
    uint64_t count[2] = {};
    for (const bool coarse : {false, true}) {
      BlurScene s;
      Attributes attributes;
      attributes.motion_factor = coarse ? 1e3f : 0.0f;
      Surface& surface =
          s.add(geometry(Quadric{Quadric::Kind::sphere, {{1, -1, 1, 360}}}), {}, attributes);
      surface.world_from_object = MovingTransform(
          {0.0f, 1.0f}, {shift(0, 0, distance), shift(60 / scale * distance, 0, distance)});
      for (const auto& g : s.all_grids()) {
        count[coarse] += uint64_t(g->micropolygon_count());
        for (int j = 0; j <= g->v_count; ++j) {
          for (int i = 0; i < g->u_count; ++i) {
            const int k = j * (g->u_count + 1) + i;
            const auto P = [&](int at) {
              return glm::dvec3(g->P(0, 0)[at], g->P(0, 1)[at], g->P(0, 2)[at] - distance);
            };
            const double inside = 1 - glm::length(0.5 * (P(k) + P(k + 1)));
            sag[coarse] = std::max(sag[coarse], inside * scale / distance);
          }
        }
      }
    }
    INFO("distance " << distance << " micropolygons " << count[0] << " " << count[1]);
    CHECK(count[1] < count[0]);
    CHECK(sag[1] < std::max(1.1 * sag[0], 0.045));
  }
}

TEST_CASE("no part of a receding floor is coarser than its own blur allows", "[dice][blur]") {
  BlurScene s;
  s.focus(1.4, 1.0, 10);
  Attributes attributes;
  attributes.focus_factor = 4;
  PatchMesh mesh;
  mesh.u_vertices = mesh.v_vertices = 2;
  s.add(geometry(mesh, {{-9, -1, 2}, {9, -1, 2}, {-30, -1, 60}, {30, -1, 60}}), glm::dmat4(1),
        attributes);
  const Camera camera(s.scene.camera);
  size_t coarse = 0, sharp = 0;
  for (const auto& g : s.all_grids()) {
    for (int k = 0; k < g->vertex_count(); ++k) {
      // Vertices on the boundary lie where those of the edges do.
      const int i = k % (g->u_count + 1), j = k / (g->u_count + 1);
      if (i == 0 || i + 1 >= g->u_count || j == 0 || j == g->v_count) continue;
      const auto raster = [&](int at) {
        const glm::vec3 c =
            camera.raster_clip_from_camera({g->P(0, 0)[at], g->P(0, 1)[at], g->P(0, 2)[at]});
        return glm::vec2(c.x, c.y) / c.z;
      };
      const glm::vec2 a = raster(k), b = raster(k + 1);
      if (std::max(std::abs(a.x - 100), std::abs(b.x - 100)) > 100) continue;
      const double diameter = 2 * std::abs(camera.coc_raster(g->P(0, 2)[k]).y);
      const double side = glm::distance(a, b);
      CHECK(side < 1.3 * std::max(1.0, std::sqrt(4 * diameter / 16)));
      coarse += side > 1.6;
      sharp += diameter < 2;
    }
  }
  CHECK(coarse > 100);
  CHECK(sharp > 1000);
}

}  // namespace
}  // namespace tessera::test
