#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

#include "tests/shade/fixtures.h"

using namespace tessera;
using namespace tessera::test;

namespace {

Parameter point(const char* name, glm::vec3 v) { return triple(name, ValueType::point, v); }

/// Largest difference over the vertices of `grid` between the shader and `expected(P)`.
double largest_error(const SurfaceColors& colors, const Grid& grid,
                     const std::function<glm::dvec3(glm::dvec3 P)>& expected) {
  double worst = 0.0;
  for (int i = 0; i < grid.vertex_count(); ++i) {
    const glm::dvec3 P(grid.P(0, 0)[i], grid.P(0, 1)[i], grid.P(0, 2)[i]);
    const glm::dvec3 difference = glm::abs(glm::dvec3(colors.Ci[i]) - expected(P));
    worst = std::max({worst, difference.x, difference.y, difference.z});
  }
  return worst;
}

}  // namespace

TEST_CASE("matte under a distant light is Os * Cs * Kd * cos") {
  TestScene test;
  test.add_light(call("distantlight", {number("intensity", 2.0f), point("from", {3, 0, -4})}));
  test.scene.lights[0].shader.parameters.push_back(point("to", {0, 0, 0}));
  Attributes attributes;
  attributes.surface = call("matte", {number("Kd", 0.7f)});
  attributes.color = {1.0f, 0.5f, 0.25f};
  attributes.opacity = {0.5f, 1.0f, 1.0f};
  const Surface& surface = test.add_surface(attributes);
  const auto grid = make_square(surface, 3, 5.0f);
  const auto bindings = test.bind();
  const SurfaceColors colors = run_surface(*bindings, *grid);
  const glm::dvec3 expected = glm::dvec3(0.5, 0.5, 0.25) * (0.7 * 2.0 * 0.8);
  CHECK(largest_error(colors, *grid, [&](glm::dvec3) { return expected; }) < 1e-6);
  CHECK(colors.Oi[5] == glm::vec3(0.5f, 1.0f, 1.0f));
}

TEST_CASE("a surface seen from behind is lit on the side that is seen") {
  TestScene test;
  test.add_light(call("distantlight", {point("from", {0, 0, 0}), point("to", {0, 0, 1})}));
  const Surface& surface = test.add_surface("matte");
  const auto grid = make_square(surface, 1, 5.0f);
  for (size_t k = 0; k < grid->stride(); ++k) grid->N_camera[2 * grid->stride() + k] = 1.0f;
  const auto bindings = test.bind();
  CHECK(run_surface(*bindings, *grid).Ci[0].x == Approx(1.0));
}

TEST_CASE("light from behind gives neither diffuse nor specular") {
  TestScene test;
  test.add_light(call("distantlight", {point("from", {0, 0, 9}), point("to", {0, 0, 0})}));
  // Just below the horizon the half vector still leans to the side of the normal.
  test.add_light(call("distantlight", {point("from", {9, 0, 1}), point("to", {0, 0, 0})}));
  const Surface& surface = test.add_surface("plastic", {number("roughness", 10.0f)});
  const auto grid = make_square(surface, 2, 5.0f);
  const auto bindings = test.bind();
  CHECK(largest_error(run_surface(*bindings, *grid), *grid,
                      [](glm::dvec3) { return glm::dvec3(0.0); }) == 0.0);
}

TEST_CASE("under ambient light alone every reflecting shader returns Ka * Cs") {
  for (const char* shader : {"matte", "metal", "plastic", "paintedplastic", "shinymetal"}) {
    TestScene test;
    test.add_light(call("ambientlight", {number("intensity", 0.5f)}));
    test.add_light(call("ambientlight", {number("intensity", 0.25f)}));
    Attributes attributes;
    attributes.surface = call(shader, {number("Ka", 0.8f)});
    attributes.color = {1.0f, 0.5f, 0.0f};
    const auto grid = make_square(test.add_surface(attributes), 2, 3.0f);
    const auto bindings = test.bind();
    INFO(shader);
    CHECK(largest_error(run_surface(*bindings, *grid), *grid,
                        [](glm::dvec3) { return 0.8 * 0.75 * glm::dvec3(1.0, 0.5, 0.0); }) < 1e-6);
  }
}

TEST_CASE("plastic under a point light agrees with the formula in double precision") {
  TestScene test;
  test.add_light(call("pointlight", {number("intensity", 30.0f), point("from", {1, 2, 1})}));
  const Surface& surface = test.add_surface(
      "plastic", {number("Kd", 0.6f), number("Ks", 0.9f), number("roughness", 0.07f),
                  triple("specularcolor", ValueType::color, {1, 0.5f, 0})});
  const auto grid = make_square(surface, 16, 4.0f);
  const auto bindings = test.bind();
  // At bare points: over a cell the half vector turns and the highlight widens.
  const SurfaceColors colors = run_surface(*bindings, *grid, Footprints::none);
  const double error = largest_error(colors, *grid, [](glm::dvec3 P) {
    const glm::dvec3 N(0, 0, -1), towards = glm::dvec3(1, 2, 1) - P;
    const double d = glm::length(towards);
    const glm::dvec3 L = towards / d, V = -P / glm::length(P), H = glm::normalize(L + V);
    const double Cl = 30.0 / (d * d);
    const double diffuse = Cl * glm::dot(N, L);
    const double specular = Cl * std::pow(std::max(0.0, glm::dot(N, H)), 1.0 / 0.07);
    return glm::dvec3(0.6 * diffuse) + 0.9 * specular * glm::dvec3(1.0, 0.5, 0.0);
  });
  CHECK(error < 2e-5);
}

TEST_CASE("a metal's highlight peaks where the half vector is the normal") {
  // Eye at the origin, light at the mirror image of nothing but itself: from (2, 0, 0) the mirror
  // point of the plane z = 4 lies half way, at x = 1.
  TestScene test;
  test.add_light(call("pointlight", {point("from", {2, 0, 0})}));
  const Surface& surface = test.add_surface("metal", {number("roughness", 0.001f)});
  const auto grid = make_grid(
      surface, 64, 1, [](float u, float v) { return glm::vec3(2.0f * u, 1e-3f * v, 4.0f); });
  const auto bindings = test.bind();
  const SurfaceColors colors = run_surface(*bindings, *grid, Footprints::none);
  int brightest = 0;
  for (int i = 0; i <= 64; ++i) {
    if (colors.Ci[i].x > colors.Ci[brightest].x) brightest = i;
  }
  CHECK(brightest == 32);
  CHECK(colors.Ci[32].x == Approx(1.0 / 17.0));
}

TEST_CASE("the default surface is lit from the eye by cos^2") {
  TestScene test;
  const auto grid = make_square(test.add_surface(Attributes{}), 4, 2.0f);
  const auto bindings = test.bind();
  CHECK(largest_error(run_surface(*bindings, *grid), *grid, [](glm::dvec3 P) {
          return glm::dvec3(0.2 + 0.8 * P.z * P.z / glm::dot(P, P));
        }) < 1e-6);
  CHECK(test.diagnostics.lines().empty());
}

TEST_CASE("constant ignores light and takes varying colours") {
  TestScene test;
  const auto grid = make_square(test.add_surface("constant"), 2, 2.0f);
  const auto Cs = add_primvar(*grid, "Cs", ValueType::color, [](float u, float v) {
    return std::vector<float>{u, v, 1.0f};
  });
  const auto Os = add_primvar(*grid, "Os", ValueType::color, [](float, float v) {
    return std::vector<float>{1.0f, v, 0.5f};
  });
  const auto bindings = test.bind();
  const SurfaceColors colors = run_surface(*bindings, *grid);
  CHECK(colors.Ci[5] == glm::vec3(1.0f, 0.25f, 0.5f));  // u = 1, v = 1/2
  CHECK(colors.Oi[5] == glm::vec3(1.0f, 0.5f, 0.5f));
}

TEST_CASE("fade mixes its opacities by the angle to the view") {
  TestScene test;
  const Surface& surface = test.add_surface(
      "fade", {number("facing", 0.1f), number("edge", 0.9f), number("power", 2.0f)});
  const auto grid = make_square(surface, 8, 1.0f);
  const auto bindings = test.bind();
  const double error = largest_error(run_surface(*bindings, *grid), *grid, [](glm::dvec3 P) {
    const double rim = 1.0 - P.z / glm::length(P);
    return glm::dvec3(0.1 + 0.8 * rim * rim);
  });
  CHECK(error < 1e-6);
  CHECK(may_be_transparent(*bindings, surface));
}

TEST_CASE("lights that a surface does not list leave it dark") {
  TestScene test;
  const Surface& dark = test.add_surface("matte");
  test.add_light(call("ambientlight"));
  const auto grid = make_square(dark, 1, 2.0f);
  const auto bindings = test.bind();
  CHECK(run_surface(*bindings, *grid).Ci[0] == glm::vec3(0.0f));
}
