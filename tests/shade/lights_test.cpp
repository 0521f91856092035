#include <catch2/catch.hpp>

#include <cmath>

#include "tests/shade/fixtures.h"

using namespace tessera;
using namespace tessera::test;

namespace {

/// What one light sends to points.
struct Lit {
  LightSamples samples;
  Diagnostics diagnostics;

  Lit(const std::string& name, std::vector<Parameter> parameters, const std::vector<glm::vec3>& P,
      const glm::dmat4& camera_from_shader = glm::dmat4(1.0)) {
    const LightDefinition* definition = find_light(name);
    REQUIRE(definition);
    const BoundParameters bound(definition->parameters, call(name, std::move(parameters)),
                                {camera_from_shader, glm::inverse(camera_from_shader)}, name,
                                diagnostics);
    Vec3Array positions(int(P.size()));
    for (int i = 0; i < int(P.size()); ++i) positions.set(i, P[size_t(i)]);
    ShadingPoints points;
    points.count = int(P.size());
    points.P = positions;
    samples.L.reset(points.count);
    samples.Cl.reset(points.count);
    definition->illuminate(bound, points, samples);
  }
};

}  // namespace

TEST_CASE("an ambient light is intensity times colour everywhere") {
  const Lit lit("ambientlight",
                {number("intensity", 0.5f), triple("lightcolor", ValueType::color, {1, 2, 4})},
                {{0, 0, 1}, {1e7f, 0, 0}});
  CHECK(lit.samples.Cl[0] == glm::vec3(0.5f, 1.0f, 2.0f));
  CHECK(lit.samples.Cl[1] == lit.samples.Cl[0]);
}

TEST_CASE("a distant light shines along from - to, through the shader's space") {
  // A quarter turn about z and a shift: the shift must not matter, the turn must.
  glm::dmat4 turn(1.0);
  turn[0] = {0, 1, 0, 0};
  turn[1] = {-1, 0, 0, 0};
  turn[3] = {5, 6, 7, 1};
  const Lit lit(
      "distantlight",
      {triple("from", ValueType::point, {3, 0, 0}), triple("to", ValueType::point, {1, 0, 0})},
      {{0, 0, 1}}, turn);
  CHECK(glm::length(lit.samples.L[0] - glm::vec3(0, 1, 0)) < 1e-6f);
  CHECK(lit.samples.Cl[0] == glm::vec3(1.0f));
}

TEST_CASE("a distant light without a direction is dark, not NaN") {
  const Lit lit("distantlight", {triple("to", ValueType::point, {0, 0, 0})}, {{0, 0, 1}});
  CHECK(lit.samples.Cl[0] == glm::vec3(0.0f));
}

TEST_CASE("lights with an axis shine along it however long it is") {
  for (const float length : {1e-23f, 1e-10f, 1.0f, 1e10f, 1e20f, 1e38f}) {
    INFO(length);
    const Lit distant("distantlight",
                      {triple("from", ValueType::point, {0, 0, 0}),
                       triple("to", ValueType::point, {0.6f * length, 0, 0.8f * length})},
                      {{0, 0, 1}});
    CHECK(glm::length(distant.samples.L[0] - glm::vec3(-0.6f, 0, -0.8f)) < 1e-6f);
    CHECK(distant.samples.Cl[0] == glm::vec3(1.0f));
    const Lit spot("spotlight",
                   {triple("from", ValueType::point, {0, 0, 0}),
                    triple("to", ValueType::point, {0.6f * length, 0, 0.8f * length})},
                   {{1.2f, 0, 1.6f}});
    CHECK(spot.samples.Cl[0].x == Approx(0.25));
  }
}

TEST_CASE("a point light falls off with the square of the distance") {
  const Lit lit("pointlight",
                {number("intensity", 8.0f), triple("from", ValueType::point, {1, 2, 3})},
                {{1, 2, 5}, {1, -2, 3}, {1, 2, 3}});
  CHECK(lit.samples.Cl[0].x == Approx(8.0 / 4.0));
  CHECK(lit.samples.Cl[1].x == Approx(8.0 / 16.0));
  CHECK(lit.samples.L[0] == glm::vec3(0, 0, -1));
  CHECK(lit.samples.L[1] == glm::vec3(0, 1, 0));
  CHECK(lit.samples.Cl[2] == glm::vec3(0.0f));  // at the light itself
}

TEST_CASE("a point light very near and very far stays finite") {
  const Lit lit("pointlight", {}, {{0, 0, 1e-15f}, {0, 0, 1e25f}});
  CHECK(lit.samples.Cl[0].x == Approx(1e30));
  CHECK(std::isfinite(lit.samples.Cl[1].x));
}

TEST_CASE("a spot light follows its closed form across the cone") {
  const double cone = 0.6, delta = 0.2, power = 3.0, intensity = 9.0;
  std::vector<glm::vec3> P;
  std::vector<double> angles;
  for (double angle = 0.0; angle < 1.0; angle += 0.03) {
    angles.push_back(angle);
    P.push_back({3.0 * std::sin(angle), 0.0, 3.0 * std::cos(angle)});
  }
  const Lit lit("spotlight",
                {number("intensity", float(intensity)), number("coneangle", float(cone)),
                 number("conedeltaangle", float(delta)), number("beamdistribution", float(power))},
                P);
  for (size_t i = 0; i < P.size(); ++i) {
    const double c = std::cos(angles[i]), outer = std::cos(cone), inner = std::cos(cone - delta);
    const double a = std::min(1.0, std::max(0.0, (c - outer) / (inner - outer)));
    const double expected = intensity * std::pow(c, power) / 9.0 * a * a * (3.0 - 2.0 * a);
    CHECK(lit.samples.Cl[int(i)].y == Approx(expected).margin(2e-5));
  }
}

TEST_CASE("a spot light whose soft edge has no width is a step") {
  const Lit lit("spotlight", {number("coneangle", 0.5f), number("conedeltaangle", 0.0f)},
                {{std::sin(0.49f), 0, std::cos(0.49f)}, {std::sin(0.51f), 0, std::cos(0.51f)}});
  CHECK(lit.samples.Cl[0].x == Approx(std::cos(0.49) * std::cos(0.49)));
  CHECK(lit.samples.Cl[1].x == 0.0f);
}

TEST_CASE("unknown lights are judged by their parameters and named once") {
  Diagnostics diagnostics;
  const auto point = [](const char* name) {
    return triple(name, ValueType::point, glm::vec3(0.0f));
  };
  CHECK(choose_light(call("uberlight", {number("coneangle", 1)}), diagnostics)->name ==
        "spotlight");
  CHECK(choose_light(call("sun", {point("from"), point("to")}), diagnostics)->name ==
        "distantlight");
  CHECK(choose_light(call("bulb", {point("from")}), diagnostics)->name == "pointlight");
  CHECK(choose_light(call("mystery"), diagnostics) == nullptr);
  CHECK(choose_light(call("lights/pointlight.slo"), diagnostics)->name == "pointlight");
  REQUIRE(diagnostics.lines().size() == 4);
  CHECK_THAT(diagnostics.lines()[0],
             Catch::StartsWith("scene.rib:7:") && Catch::Contains("uberlight"));
  choose_light(call("mystery"), diagnostics);
  CHECK(diagnostics.lines().size() == 4);
  CHECK(choose_light(call("shadowspot"), diagnostics)->name == "shadowspot");
}
