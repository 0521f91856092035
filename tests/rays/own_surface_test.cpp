// Rays that start on a surface, against the dice of that surface and of those it touches.

#include <catch2/catch.hpp>

#include <glm/gtc/matrix_transform.hpp>

#include "dice/whole_scene.h"
#include "tests/rays/ray_scene.h"

using namespace tessera;
using namespace tessera::test;

namespace {

Geometry unit_sphere() {
  Quadric sphere;
  sphere.kind = Quadric::Kind::sphere;
  sphere.parameters = {{1, -1, 1, 360}};
  return geometry(sphere);
}

Geometry rectangle(float size) {
  return geometry(PatchMesh{},
                  {{-size, 0, -size}, {size, 0, -size}, {-size, 0, size}, {size, 0, size}});
}

glm::dmat4 placed(const glm::dvec3& at, double scale = 1) {
  return glm::scale(glm::translate(glm::dmat4(1.0), at), glm::dvec3(scale));
}

glm::dvec3 random_direction(std::mt19937& random) {
  std::normal_distribution<double> x;
  const double a = x(random), b = x(random), c = x(random);
  return glm::normalize(glm::dvec3(a, b, c));
}

/// A direction at `elevation` radians above the plane through the origin across `n`.
glm::dvec3 raised(const glm::dvec3& n, double elevation, std::mt19937& random) {
  const glm::dvec3 along = glm::normalize(glm::cross(n, random_direction(random)));
  return std::sin(elevation) * n + std::cos(elevation) * along;
}

RaySettings rate(float area) {
  RaySettings settings;
  settings.dicing_rate = area;
  return settings;
}

/// Of the micropolygons that rays meet.
double longest_diagonal(const RayTracer& tracer) {
  double longest = 0;
  for (const auto& grid : tracer.grids()) {
    for (uint32_t t = 0; t < 2 * uint32_t(grid->micropolygon_count()); t += 2) {
      const auto corners = grid->triangle_corners(t);
      const auto P = [&](size_t c) { return vertex_at(*grid, corners[c], 0); };
      longest = std::max(longest, double(glm::length(P(2) - P(0))));
    }
  }
  return longest;
}

constexpr double centre_z = 4;
const glm::dvec3 centre(0, 0, centre_z);

}  // namespace

TEST_CASE("a sphere does not shadow itself from outside", "[rays]") {
  for (const float area : {16.0f, 100.0f, 2000.0f}) {
    DiceScene scene;
    scene.add(unit_sphere(), placed(centre));
    const auto tracer = tracer_of(scene, rate(area));
    std::mt19937 random(5);
    for (int k = 0; k < 3000; ++k) {
      const glm::dvec3 n = random_direction(random);
      const double elevation = std::pow(10.0, -6.0 * k / 3000);
      const glm::vec3 direction(raised(n, elevation, random));
      const RayHits hits =
          closest(*tracer, one_ray(glm::vec3(centre + n), direction, INFINITY, 0, 0));
      CHECK(hits.distance[0] == INFINITY);
    }
  }
}

TEST_CASE("inside a sphere the far wall is met where it is, the near one is not", "[rays]") {
  for (const float area : {1.0f, 4.0f, 25.0f}) {
    DiceScene scene;
    scene.add(unit_sphere(), placed(centre));
    const auto tracer = tracer_of(scene, rate(area));
    const double longest = longest_diagonal(*tracer);
    REQUIRE(longest < 0.6);
    std::mt19937 random(6);
    int met = 0;
    for (int k = 0; k < 3000; ++k) {
      const glm::dvec3 n = random_direction(random);
      const double elevation = 1.5 * (k + 1) / 3000, expected = 2 * std::sin(elevation);
      const glm::vec3 direction(raised(-n, elevation, random));
      const float t =
          closest(*tracer, one_ray(glm::vec3(centre + n), direction, INFINITY, 0, 0)).distance[0];
      // A chord about as short as a micropolygon may stay behind it.
      const bool is_short = expected < 1.35 * longest;
      met += !is_short;
      if (!is_short || t < INFINITY) CHECK(double(t) == Approx(expected).margin(0.3 * longest));
    }
    CHECK(met > 1500);
  }
}

TEST_CASE("a curved patch in motion lets its own light through", "[rays]") {
  // A paraboloid y = -x^2 - z^2 / 2 (convex from above) that drifts.
  DiceScene scene;
  Geometry g = geometry(bicubic_mesh());
  g.key_times = {0, 1};
  for (int key = 0; key < 2; ++key) {
    std::vector<glm::vec3> points;
    // Bezier points of x^2 over [-1, 1]: 1, -1/3, -1/3, 1.
    const float square[4] = {1, -1.0f / 3, -1.0f / 3, 1}, line[4] = {-1, -1.0f / 3, 1.0f / 3, 1};
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 4; ++i) {
        points.emplace_back(line[i] + float(key), -square[i] - 0.5f * square[j], line[j] + 5);
      }
    }
    g.P_object.push_back(points);
  }
  scene.add(std::move(g));
  const auto tracer = tracer_of(scene, rate(400));
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-0.95, 0.95);
  for (int k = 0; k < 3000; ++k) {
    const double x = uniform(random), z = uniform(random), t = 0.5 + 0.5 * uniform(random);
    const glm::dvec3 n = glm::normalize(glm::dvec3(2 * x, 1, z));
    const glm::dvec3 P(x + t, -x * x - 0.5 * z * z, z + 5);
    const glm::vec3 direction(raised(n, std::pow(10.0, -5.0 * k / 3000), random));
    const RayShadows found =
        shadow(*tracer, one_ray(glm::vec3(P), direction, INFINITY, float(t), 0));
    CHECK(found.share[0] == 1.0f);
    // It is a roof over what is below it.
    const glm::dvec3 below = P - glm::dvec3(0, 0.5, 0);
    CHECK(shadow(*tracer, one_ray(glm::vec3(below), {0, 1, 0}, INFINITY, float(t))).share[0] ==
          0.0f);
  }
}

TEST_CASE("a saddle neither shadows itself nearby nor lets through what it stops", "[rays]") {
  // y = x^2 - z^2 over [-1, 1]^2: light in a plane of constant z is stopped by the wall that rises.
  DiceScene scene;
  std::vector<glm::vec3> points;
  const float square[4] = {1, -1.0f / 3, -1.0f / 3, 1}, line[4] = {-1, -1.0f / 3, 1.0f / 3, 1};
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) points.emplace_back(line[i], square[i] - square[j], line[j] + 5);
  }
  scene.add(geometry(bicubic_mesh(), points));
  const auto tracer = tracer_of(scene, rate(36));
  const double longest = longest_diagonal(*tracer);
  std::mt19937 random(9);
  std::uniform_real_distribution<double> uniform(-0.9, 0.9);
  int stopped = 0, passed = 0;
  for (int k = 0; k < 4000; ++k) {
    // y - x^2 + z^2 along the ray is rise t - fall t^2.
    const double x = uniform(random), z = uniform(random);
    const glm::dvec3 n = glm::normalize(glm::dvec3(-2 * x, 1, 2 * z));
    const glm::dvec3 d = raised(n, 0.8 * std::pow(10.0, -2.0 * k / 4000), random);
    const double rise = d.y - 2 * x * d.x + 2 * z * d.z, fall = d.x * d.x - d.z * d.z;
    const double leaves = std::min((1 - x * std::copysign(1.0, d.x)) / std::abs(d.x),
                                   (1 - z * std::copysign(1.0, d.z)) / std::abs(d.z));
    const double meets = fall > 0 ? rise / fall : INFINITY;
    // How far micropolygons are from the saddle at most: what comes nearer is left to chance.
    const double sag = 0.25 * longest * longest;
    const auto height = [&](double t) { return rise * t - fall * t * t; };
    if (height(longest) < sag) continue;
    const RayHits hits =
        closest(*tracer, one_ray(glm::vec3(x, x * x - z * z, z + 5), glm::vec3(d), INFINITY, 0, 0));
    if (height(leaves) > sag) {
      ++passed;
      CHECK(hits.distance[0] == INFINITY);
    } else if (meets < leaves - longest) {
      ++stopped;
      CHECK(double(hits.distance[0]) == Approx(meets).margin(1.1 * sag / rise));
    }
  }
  CHECK(stopped > 50);
  CHECK(passed > 1000);
}

TEST_CASE("a box on a floor shadows the floor up to its edge", "[rays]") {
  DiceScene scene;
  Geometry box = geometry(PolygonMesh{std::vector<int>(6, 1), std::vector<int>(6, 4), cube_faces},
                          cube_points());
  scene.add(rectangle(20), placed({0, -1, 6}));
  scene.add(std::move(box), placed({0, 0, 6}));
  const auto tracer = tracer_of(scene);
  std::mt19937 random(8);
  std::uniform_real_distribution<float> uniform(-0.99f, 0.99f);
  for (const float gap : {1e-4f, 1e-3f, 1e-2f}) {
    for (int k = 0; k < 200; ++k) {
      const float z = 6 + uniform(random), rise = std::abs(uniform(random));
      // Towards the box and up: blocked; away from it: open.
      const glm::vec3 P(1 + gap, -1, z);
      const RayShadows in = shadow(*tracer, one_ray(P, {-1, rise, 0}, INFINITY, 0, 0));
      CHECK(in.share[0] == 0.0f);
      CHECK(in.distance[0] == Approx(gap).epsilon(0.02));
      CHECK(shadow(*tracer, one_ray(P, {1, rise + 0.01f, 0}, INFINITY, 0, 0)).share[0] == 1.0f);
      // The box's own foot sees the floor.
      const glm::vec3 foot(1, -1 + gap, z);
      CHECK(shadow(*tracer, one_ray(foot, {rise, -1, 0}, INFINITY, 0, 1)).share[0] == 0.0f);
    }
  }
}

TEST_CASE("faces of one mesh shadow each other up to their common edge", "[rays]") {
  // A step: two faces of one surface that meet at a right angle.
  DiceScene scene;
  scene.add(geometry(PolygonMesh{{1, 1}, {4, 4}, {0, 1, 2, 3, 3, 2, 4, 5}},
                     {{-5, -1, 4}, {5, -1, 4}, {5, -1, 8}, {-5, -1, 8}, {5, 3, 8}, {-5, 3, 8}}));
  const auto tracer = tracer_of(scene);
  for (const float gap : {1e-4f, 1e-3f, 1e-1f}) {
    for (float x = -4.5f; x < 4.5f; x += 0.1f) {
      const glm::vec3 P(x, -1, 8 - gap);
      CHECK(closest(*tracer, one_ray(P, {0.1f, 0.5f, 1}, INFINITY, 0, 0)).distance[0] ==
            Approx(gap).epsilon(0.02));
      CHECK(closest(*tracer, one_ray(P, {0.1f, 0.01f, -1}, INFINITY, 0, 0)).distance[0] ==
            INFINITY);
    }
  }
}

namespace {

/// Waves along u that the coarse vertices can only guess at.
class Waves final : public Displacer {
 public:
  static constexpr float height = 0.02f;
  void displace(const Grid& grid, std::span<float> distance) const override {
    const float* u = grid.uv.data();
    const float* v = u + grid.stride();
    for (int k = 0; k < grid.vertex_count(); ++k)
      distance[size_t(k)] = height * std::sin(40 * u[k]) * std::sin(37 * v[k]);
  }
};

}  // namespace

TEST_CASE("the fine vertices of a displaced surface see the sky above it", "[rays]") {
  DiceScene scene;
  Attributes attributes;
  attributes.displacement = ShaderCall{};
  attributes.displacement_bound = 2 * Waves::height;
  scene.add(rectangle(1), placed({0, -1, 4}), attributes);
  const Waves waves;
  RaySettings settings = rate(64);
  settings.displacer = &waves;
  const auto tracer = tracer_of(scene, settings);
  scene.settings.dicing_rate = 1;
  scene.settings.displacer = &waves;
  const Grids fine =
      dice_whole_scene(scene.scene, Camera(scene.scene.camera), scene.settings, scene.diagnostics);
  size_t open = 0, all = 0;
  for (const auto& grid : fine) {
    for (int k = 0; k < grid->vertex_count(); ++k) {
      const glm::vec3 P(grid->P(0, 0)[k], grid->P(0, 1)[k], grid->P(0, 2)[k]);
      const float sign = grid->N(1)[k] > 0 ? 1.0f : -1.0f;
      const glm::vec3 up = glm::vec3(0.3f, 1, 0.2f) * sign;
      ++all;
      open += shadow(*tracer, one_ray(P, up, INFINITY, 0, 0)).share[0] == 1.0f;
    }
  }
  CHECK(all > 2000);
  CHECK(double(open) / double(all) > 0.995);
}
