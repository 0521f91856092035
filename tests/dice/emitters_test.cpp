// Grids of surfaces that shine: by shape, whatever is seen of them.

#include <catch2/catch.hpp>

#include <numbers>

#include <tbb/global_control.h>

#include <glm/gtc/matrix_transform.hpp>

#include "dice/whole_scene.h"
#include "tests/dice/dice_scene.h"

using namespace tessera;
using namespace tessera::test;

namespace {

constexpr double pi = std::numbers::pi;

Attributes shining() {
  Attributes attributes;
  attributes.area_light = 0;
  return attributes;
}

Geometry quadric(Quadric::Kind kind, std::array<double, 7> parameters) {
  Quadric shape;
  shape.kind = kind;
  shape.parameters = {std::vector<double>(parameters.begin(), parameters.end())};
  return geometry(shape);
}

glm::dmat4 at_distance(double z) {
  return glm::translate(glm::dmat4(1.0), glm::dvec3(0.1, -0.05, z));
}

Grids emitters(DiceScene& scene) {
  return dice_emitters(scene.scene, Camera(scene.scene.camera), scene.settings, scene.diagnostics);
}
Grids whole(DiceScene& scene) {
  return dice_whole_scene(scene.scene, Camera(scene.scene.camera), scene.settings,
                          scene.diagnostics);
}

double area_of(const Grids& grids) {
  double doubled = 0;
  for (const auto& grid : grids) {
    for (uint32_t t = 0; t < uint32_t(2 * grid->micropolygon_count()); ++t) {
      glm::dvec3 p[3];
      const auto corners = grid->triangle_corners(t);
      for (int c = 0; c < 3; ++c)
        for (int axis = 0; axis < 3; ++axis) p[c][axis] = grid->P(0, axis)[corners[size_t(c)]];
      doubled += glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
    }
  }
  return doubled / 2;
}

size_t micropolygons_of(const Grids& grids) {
  size_t count = 0;
  for (const auto& grid : grids) count += size_t(grid->micropolygon_count());
  return count;
}

bool same_bits(const Grids& a, const Grids& b) {
  return std::ranges::equal(a, b, [](const auto& x, const auto& y) {
    return x->id == y->id && x->P_camera == y->P_camera && x->N_camera == y->N_camera;
  });
}

/// The area of the only surface that shines, without others.
double area_of_emitter(Geometry shape) {
  DiceScene scene;
  scene.add(std::move(shape), at_distance(20), shining());
  return area_of(emitters(scene));
}

}  // namespace

TEST_CASE("emitters: a ball has its area at every distance and format", "[emitters]") {
  for (const auto& [width, height] : {std::pair{1, 1}, {7, 1}, {640, 480}}) {
    for (const double distance : {-30.0, 0.0, 10.0, 30.0, 100.0, 400.0, 2000.0}) {
      DiceScene scene(width, height);
      scene.settings.dicing_rate = 100;
      scene.add(quadric(Quadric::Kind::sphere, {0.1, -0.1, 0.1, 360}), at_distance(distance),
                shining());
      scene.add(quadric(Quadric::Kind::sphere, {3, -3, 3, 360}));
      const Grids grids = emitters(scene);
      CHECK(area_of(grids) == Approx(4 * pi * 0.01).epsilon(1e-3));
      if (distance <= 400) CHECK(micropolygons_of(grids) == 128 * 64);
    }
  }
}

TEST_CASE("emitters: curved surfaces have their area within a thousandth", "[emitters]") {
  CHECK(area_of_emitter(quadric(Quadric::Kind::torus, {1, 0.2, 0, 360, 360})) ==
        Approx(4 * pi * pi * 0.2).epsilon(1e-3));
  CHECK(area_of_emitter(quadric(Quadric::Kind::torus, {1, 0.001, 0, 360, 360})) ==
        Approx(4 * pi * pi * 0.001).epsilon(1e-3));
  CHECK(area_of_emitter(quadric(Quadric::Kind::disk, {0, 0.5, 360})) ==
        Approx(pi * 0.25).epsilon(1e-3));
  CHECK(area_of_emitter(quadric(Quadric::Kind::cylinder, {0.5, -1, 1, 90})) ==
        Approx(pi / 2).epsilon(1e-3));
  // r^2 = z: 4 pi / 3 * ((1/4 + z)^(3/2) - 1/8) from the vertex to z.
  CHECK(area_of_emitter(quadric(Quadric::Kind::paraboloid, {1, 0, 1, 360})) ==
        Approx(4 * pi / 3 * (std::pow(1.25, 1.5) - 0.125)).epsilon(1e-3));
}

TEST_CASE("emitters: a twisted patch has its area", "[emitters]") {
  // z = h x y over [-1, 1]^2, straight along u and along v. Its normal turns by 2 atan(h) in the
  // middle.
  for (const float h : {1.0f, 8.0f}) {
    DiceScene scene;
    scene.add(geometry(PatchMesh{}, {{-1, -1, h}, {1, -1, -h}, {-1, 1, -h}, {1, 1, h}}),
              at_distance(20), shining());
    long double expected = 0;
    constexpr int n = 400;
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        const long double x = (2 * i + 1.0L) / n - 1, y = (2 * j + 1.0L) / n - 1;
        expected += std::sqrt(1 + h * h * (x * x + y * y)) * 4 / (n * n);
      }
    }
    const Grids grids = emitters(scene);
    CHECK(area_of(grids) == Approx(double(expected)).epsilon(1e-3));
    const double across = std::max(32.0, 2 * std::atan(double(h)) / (2 * pi) * 128 - 1);
    CHECK(double(micropolygons_of(grids)) >= across * across);
  }
}

TEST_CASE("emitters: subdivision surfaces have the area of ever finer dices", "[emitters]") {
  for (const bool torus : {false, true}) {
    const Geometry cage = torus ? geometry(torus_cage(8, 5), torus_points(8, 5))
                                : geometry(cube_cage(), cube_points());
    DiceScene scene(640, 480);
    scene.settings.dicing_rate = 1;
    scene.add(cage, at_distance(4));
    const double expected = area_of(whole(scene));
    CHECK(area_of_emitter(cage) == Approx(expected).epsilon(1e-3));
  }
}

TEST_CASE("emitters: what is flat is exact with as few micropolygons as it can", "[emitters]") {
  const std::vector<glm::vec3> corners{{-1, -0.5, 0.25}, {2, -1, 0}, {-1, 1, 0.25}, {1, 2, 0}};
  const auto flattened = [&](float size) {
    std::vector<glm::vec3> points = corners;
    for (glm::vec3& p : points) p = size * glm::vec3(p.x, p.y, 0.3f * p.x - 0.2f * p.y);
    return points;
  };
  for (const float size : {1e-3f, 1.0f, 1e4f}) {
    const std::vector<glm::vec3> p = flattened(size);
    const double expected =
        0.5 * glm::length(glm::cross(glm::dvec3(p[3] - p[0]), glm::dvec3(p[2] - p[1])));
    for (const double distance : {0.5, 400.0}) {
      DiceScene scene;
      scene.add(geometry(PatchMesh{}, p), at_distance(distance), shining());
      const Grids grids = emitters(scene);
      CHECK(area_of(grids) == Approx(expected).epsilon(1e-4 + 1e-6 * distance / double(size)));
      CHECK(micropolygons_of(grids) == 1);
    }
  }
  // Triangles are patches with a side that is one point.
  PolygonMesh mesh;
  mesh.loops_per_polygon = {1};
  mesh.vertices_per_loop = {3};
  mesh.vertices = {0, 1, 2};
  DiceScene scene;
  scene.add(geometry(mesh, {{0, 0, 0}, {1, 0, 1}, {0, 1, 1}}), at_distance(300), shining());
  CHECK(micropolygons_of(emitters(scene)) == 1);
}

TEST_CASE("emitters: points that rounding makes of one are no curve", "[emitters]") {
  // A bicubic patch whose side is one point but for the last bits, as poles of spheres are.
  std::vector<glm::vec3> points;
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) {
      const float noise = 1e-8f * float((i * 7 + j * 3) % 5);
      points.emplace_back(float(i * j) + noise, float(j * j) - noise, noise);
    }
  }
  DiceScene scene;
  scene.add(geometry(bicubic_mesh(), points), at_distance(50), shining());
  CHECK(micropolygons_of(emitters(scene)) <= 64 * 64);
}

TEST_CASE("emitters: surfaces that shine have all their motion keys, others are left out",
          "[emitters]") {
  DiceScene scene;
  scene.scene.camera.shutter_close = 1;
  Geometry moving = quadric(Quadric::Kind::sphere, {1, -1, 1, 360});
  scene.add(quadric(Quadric::Kind::sphere, {1, -1, 1, 360}), at_distance(5));
  Surface& surface = scene.add(moving, at_distance(5), shining());
  surface.world_from_object =
      MovingTransform({0, 0.5, 1}, {at_distance(5), at_distance(6), at_distance(4)});
  const Grids grids = emitters(scene);
  REQUIRE_FALSE(grids.empty());
  for (const auto& grid : grids) {
    CHECK(grid->id.surface == 1);
    CHECK(grid->key_times == std::vector<float>{0, 0.5f, 1});
    CHECK(grid->P(1, 2)[0] - grid->P(0, 2)[0] == Approx(1));
  }
}

TEST_CASE("emitters: rays meet what shines, bit for bit, unless it is flat", "[emitters]") {
  DiceScene scene;
  scene.settings.max_grid_size = 16;
  scene.settings.dicing_rate = 2;
  scene.add(quadric(Quadric::Kind::torus, {1, 0.2, 0, 360, 360}), at_distance(3), shining());
  scene.add(geometry(cube_cage(), cube_points()), at_distance(40), shining());
  scene.add(geometry(PatchMesh{}, {{-1, -1, 0}, {1, -1, 0}, {-1, 1, 0}, {1, 1, 0}}), at_distance(3),
            shining());
  const Grids alone = emitters(scene), met = whole(scene);
  const auto of = [](const Grids& grids, uint32_t surface) {
    Grids some;
    for (const auto& grid : grids)
      if (grid->id.surface == surface) some.push_back(grid);
    return some;
  };
  CHECK(same_bits(of(alone, 0), of(met, 0)));
  CHECK(same_bits(of(alone, 1), of(met, 1)));
  CHECK(micropolygons_of(of(alone, 2)) == 1);
  CHECK(micropolygons_of(of(met, 2)) > 1000);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  CHECK(same_bits(alone, emitters(scene)));
}

TEST_CASE("emitters: displaced surfaces are diced finely all over, for rays too", "[emitters]") {
  class Still final : public Displacer {
    void displace(const Grid&, std::span<float> distance) const override {
      std::ranges::fill(distance, 0.0f);
    }
  };
  const Still still;
  DiceScene scene;
  scene.settings.displacer = &still;
  Attributes attributes = shining();
  attributes.displacement = ShaderCall{};
  scene.add(geometry(PatchMesh{}, {{-1, -1, 0}, {1, -1, 0}, {-1, 1, 0}, {1, 1, 0}}),
            at_distance(300), attributes);
  const Grids grids = emitters(scene);
  CHECK(micropolygons_of(grids) == emitter_micropolygons_of_displaced);
  CHECK(same_bits(grids, whole(scene)));
}

TEST_CASE("emitters: many lamps are coarser each, within bounds", "[emitters]") {
  for (const auto& [count, around] : {std::pair{size_t(64), 128}, {256, 64}, {1100, 32}}) {
    DiceScene scene;
    for (size_t k = 0; k < count; ++k) {
      scene.add(quadric(Quadric::Kind::sphere, {0.1, -0.1, 0.1, 360}),
                at_distance(10 + 0.02 * double(k)), shining());
    }
    const Grids grids = emitters(scene);
    CHECK(micropolygons_of(grids) == count * size_t(around * around / 2));
    CHECK(area_of(grids) == Approx(double(count) * 4 * pi * 0.01).epsilon(0.01));
    if (count == 256) CHECK(same_bits(grids, whole(scene)));
  }
}
