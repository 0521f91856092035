#include <catch2/catch.hpp>

#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "tests/shade/light_fixtures.h"

using namespace tessera;
using namespace tessera::test;

namespace {

/// Blocks x < 0 at depth 1.5, between lights at the origin and a square at depth 3.
std::shared_ptr<AnalyticBlocker> left_half() {
  return std::make_shared<AnalyticBlocker>(
      plane_blocker(1.5, [](double x, double) { return x < 0.0; }));
}

SurfaceColors run(const LitScene& scene, int count) {
  return run_surface(*scene.bindings, *make_square(scene.test.scene.surfaces.front(), count, 3.0f));
}

ShaderCall traced(const std::string& name, const std::string& rate) {
  return call(name, {text("shadowname", "raytrace"), text("shadowrate", rate)});
}

}  // namespace

TEST_CASE("point, spot and distant lights cast shadows by rays on request", "[light]") {
  for (const char* name : {"pointlight", "spotlight", "distantlight", "shadowspot"}) {
    LitScene plain(call(name)), by_name(traced(name, "cell")), by_attribute(call(name), "on");
    CHECK_FALSE(wants_rays(*plain.bindings));
    const SurfaceColors unshadowed = run(plain, 4);
    for (LitScene* scene : {&by_name, &by_attribute}) {
      CHECK(wants_rays(*scene->bindings));
      CHECK_FALSE(has_effect(*scene->bindings, RayEffect::shadow));
      CHECK(run(*scene, 4).Ci[7] == unshadowed.Ci[7]);  // no tracer yet
      const auto blocker = left_half();
      scene->bindings->use_rays(blocker);
      const SurfaceColors shadowed = run(*scene, 4);
      CHECK(blocker->traced == 25);
      for (const int32_t id : blocker->surfaces) CHECK(id == 0);
      for (int i = 0; i < 25; ++i) {
        CAPTURE(name, i);
        const bool left = i % 5 < 2;
        CHECK(shadowed.Ci[i] == (left ? glm::vec3(0.0f) : unshadowed.Ci[i]));
      }
    }
  }
}

TEST_CASE("ray-traced lights with a rate of their own tell their share to the term", "[light]") {
  LitScene scene(traced("pointlight", "sample"));
  REQUIRE(scene.light().term == 0u);
  scene.bindings->use_rays(left_half());
  const BarePoints at({{-0.5f, 0, 3}, {0.5f, 0, 3}}, {0, 0, -1});
  std::vector<float> share(2);
  scene.light().definition->transmission(scene.light(), at.points, share);
  CHECK(share == std::vector{0.0f, 1.0f});
  CHECK_FALSE(scene.light().definition->distributed());
}

TEST_CASE("rays end a ten thousandth of the way short of the light, and no earlier", "[light]") {
  // A lamp shade round a light at the origin, seen from 4 away: how far along it stands.
  for (const auto& [along, passes] :
       {std::pair{0.99995, true}, {0.99985, false}, {0.5, false}, {1.5, true}}) {
    LitScene scene(traced("pointlight", "cell"));
    scene.bindings->use_rays(std::make_shared<AnalyticBlocker>(
        plane_blocker(4.0 * (1.0 - along), [](double, double) { return true; })));
    const BarePoints at({{0.5f, 0.25f, 4}, {0, 0, 4}}, {0, 0, -1});
    std::vector<float> share(2);
    scene.light().definition->transmission(scene.light(), at.points, share);
    CAPTURE(along);
    CHECK(share == std::vector<float>(2, passes ? 1.0f : 0.0f));
  }
}

TEST_CASE("a map's name wins over the attribute, and off is off", "[light]") {
  const LitScene map(call("pointlight", {text("shadowname", "map.z")}), "on");
  CHECK((map.light().shadow && !map.light().ray_traced));
  const LitScene off(call("pointlight"), "off");
  CHECK_FALSE(off.light().casts_shadows());
  const LitScene distributed(call("rectanglelight"), "off");
  CHECK_FALSE(distributed.light().ray_traced);
  CHECK(distributed.light().term == 0u);
  CHECK_FALSE(wants_rays(*distributed.bindings));
}

TEST_CASE("an occlusion light without shadows is ambient, and bounces are no shadows", "[light]") {
  for (const char* rate : {"cell", "sample"}) {
    CAPTURE(rate);
    LitScene open(call("occlusionlight", {text("shadowrate", rate)}), "off");
    CHECK_FALSE(wants_rays(*open.bindings));
    CHECK_FALSE(has_effect(*open.bindings, RayEffect::bounce));
    const auto blocker = left_half();
    open.bindings->use_rays(blocker);
    CHECK(run(open, 1).Ci[0] == glm::vec3(1.0f));
    CHECK(blocker->traced == 0);
    const LitScene bounced(call("indirectlight", {text("shadowrate", rate)}), "off");
    CHECK(wants_rays(*bounced.bindings));
    CHECK(has_effect(*bounced.bindings, RayEffect::bounce) == (rate == std::string("sample")));
    CHECK(run(bounced, 1).Ci[0] == glm::vec3(0.0f));  // no tracer: nothing sends any light on
  }
}

TEST_CASE("lights with extent have the effect of shadows unless at cells", "[light]") {
  for (const char* name : {"rectanglelight", "disclight", "spherelight", "domelight"}) {
    for (const char* rate : {"cell", "pixel", "sample"}) {
      const LitScene scene(call(name, {text("shadowrate", rate)}));
      const bool at_cells = std::string(rate) == "cell";
      CHECK(wants_rays(*scene.bindings));
      CHECK(has_effect(*scene.bindings, RayEffect::shadow) == !at_cells);
      CHECK_FALSE(has_effect(*scene.bindings, RayEffect::bounce));
      CHECK(scene.light().term.has_value() == !at_cells);
    }
    CHECK(LitScene(call(name)).light().rate == TermRate::sample);
    const LitScene unknown(call(name, {text("shadowrate", "frame")}));
    CHECK(unknown.light().rate == TermRate::cell);
    CHECK(unknown.test.warned("cell, pixel, sample"));
  }
}

TEST_CASE("at cells a penumbra is the mean over the light's places", "[light]") {
  // A light over [-0.5, 0.5]^2 at depth 0 and an edge at half the way: the square at depth 3 sees
  // all of it where x > 0.5, none where x < -0.5, and a share of 1/2 + x between.
  LitScene scene(call("rectanglelight", {number("samples", 64), text("shadowrate", "cell")}));
  const SurfaceColors unblocked = run(scene, 8);
  scene.bindings->use_rays(left_half());
  const SurfaceColors blocked = run(scene, 8);
  ShadeCounters counters;
  for (int i = 0; i < 9; ++i) {
    const double x = -1.0 + 0.25 * i, expected = std::clamp(0.5 + x, 0.0, 1.0);
    const int vertex = 4 * 9 + i;
    CHECK(blocked.Ci[vertex].x / unblocked.Ci[vertex].x == Approx(expected).margin(0.02));
  }
}

TEST_CASE("rays are counted, and none is cast from what faces away", "[light]") {
  LitScene scene(call("rectanglelight", {number("samples", 4), text("shadowrate", "cell")}));
  const auto blocker = left_half();
  scene.bindings->use_rays(blocker);
  const auto grid = make_square(scene.test.scene.surfaces.front(), 2, 3.0f);
  const GridPoints batch(*grid, scene.bindings->camera(), Footprints::none);
  const BoundLight* const lights[] = {&scene.light()};
  for (const float facing : {-1.0f, 1.0f}) {
    const glm::vec3 N(0, 0, facing);
    Illumination out;
    ShadeCounters counters;
    blocker->traced = 0;
    gather_light(lights, batch.points(), Vec3Input::uniform(&N.x), nullptr, Shadows::cast, out,
                 counters);
    CHECK(counters.rays == uint64_t(blocker->traced));
    CHECK(counters.rays == (facing < 0.0f ? 36u : 0u));
    CHECK(counters.light_evaluations == 36u);
    gather_light(lights, batch.points(), Vec3Input::uniform(&N.x), nullptr, Shadows::left_out, out,
                 counters);
    CHECK(counters.rays == uint64_t(blocker->traced));
  }
}
