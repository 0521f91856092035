// Shadows by rays while surfaces or the camera move.

#include <catch2/catch.hpp>

#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "tests/shade/light_fixtures.h"

using namespace tessera;
using namespace tessera::test;

namespace {

MovingTransform from_to(const glm::dmat4& from, const glm::dmat4& to) {
  return MovingTransform({0.0f, 1.0f}, {from, to});
}

/// One light, one surface under it, and what may move. Remembers where rays start and end.
struct MovingScene {
  TestScene test;
  std::shared_ptr<ShaderBindings> bindings;
  std::vector<std::pair<glm::dvec3, glm::dvec3>> segments;

  MovingScene(ShaderCall light_call, bool surface_moves, bool camera_moves,
              const std::string& shadow = "on", double shutter_close = 1.0) {
    test.add_light(std::move(light_call));
    test.scene.lights.back().shadow = shadow;
    Surface& surface = test.add_surface("matte");
    const glm::dmat4 identity(1.0), away = glm::translate(identity, glm::dvec3(0.5, 0.2, 0.3));
    if (surface_moves) surface.world_from_object = from_to(identity, away);
    CameraSettings& camera = test.scene.camera;
    camera.shutter_close = shutter_close;
    camera.camera_from_world = MovingTransform(away);
    if (camera_moves)
      camera.camera_from_world =
          from_to(away, glm::rotate(glm::translate(identity, glm::dvec3(-1, 2, 0.5)), 0.7,
                                    glm::dvec3(0.3, 1.0, 0.2)));
    test.camera = std::make_unique<Camera>(camera);
    bindings = bind_shaders({&test.scene, test.camera.get(), &test.diagnostics, nullptr});
    bindings->use_rays(
        std::make_shared<AnalyticBlocker>([this](const glm::dvec3& o, const glm::dvec3& d) {
          segments.emplace_back(o, o + d);
          return std::numeric_limits<double>::infinity();
        }));
  }
  const BoundLight& light() const {
    return *bindings->of(*test.scene.surfaces.front().attributes).lights.at(0);
  }
  glm::dmat4 camera_from_world(float time) const { return test.camera->camera_from_world(time); }
};

/// A point of the world as a sample sees it, with a normal that turns with it.
struct SeenPoint {
  BarePoints at;
  std::vector<float> time;

  SeenPoint(const MovingScene& scene, const glm::dvec3& P_world, const glm::dvec3& N_world,
            float when)
      : at({glm::vec3(scene.camera_from_world(when) * glm::dvec4(P_world, 1.0))},
           glm::vec3(glm::dmat3(scene.camera_from_world(when)) * N_world)),
        time{when} {
    at.points.time = time.data();
  }
};

const glm::dvec3 P_world(0.4, -0.3, 6.0), N_world(0, 0, -1);

glm::dvec3 in_world(const MovingScene& scene, float time, const glm::dvec3& P_camera) {
  return glm::inverse(scene.camera_from_world(time)) * glm::dvec4(P_camera, 1.0);
}

}  // namespace

TEST_CASE("unless told otherwise, shadows by rays are a sample's own where surfaces move",
          "[light]") {
  for (const char* name : {"pointlight", "spotlight", "distantlight"}) {
    CAPTURE(name);
    CHECK(MovingScene(call(name), true, false).light().rate == TermRate::sample);
    CHECK(MovingScene(call(name), true, true).light().rate == TermRate::sample);
    CHECK(MovingScene(call(name), false, false).light().rate == TermRate::cell);
    // Where nothing but the eye moves shadows stay where they are, and cells know them.
    CHECK(MovingScene(call(name), false, true).light().rate == TermRate::cell);
    CHECK(MovingScene(call(name), true, false, "on", 0.0).light().rate == TermRate::cell);
    CHECK(MovingScene(call(name), true, false, "").light().rate == TermRate::cell);
    CHECK(MovingScene(call(name, {text("shadowname", "raytrace")}), true, false).light().rate ==
          TermRate::sample);
    CHECK(MovingScene(call(name, {text("shadowname", "map.z")}), true, false).light().rate ==
          TermRate::cell);
    CHECK(MovingScene(call(name, {text("shadowrate", "cell")}), true, false).light().rate ==
          TermRate::cell);
    CHECK(MovingScene(call(name), true, false).test.diagnostics.lines().empty());
  }
}

TEST_CASE("lights without extent stay in the world while the camera moves", "[light]") {
  const glm::dvec3 from(1, 2, -1), to(0.5, 0, 3);
  for (const char* name : {"pointlight", "distantlight"}) {
    const bool parallel = name == std::string("distantlight");
    std::vector<Parameter> parameters{triple("from", ValueType::point, {1, 2, -1})};
    if (parallel) parameters.push_back(triple("to", ValueType::point, {0.5f, 0, 3}));
    MovingScene scene(call(name, parameters), true, true);
    for (const float time : {0.0f, 0.5f, 1.0f}) {
      const SeenPoint seen(scene, P_world, N_world, time);
      std::vector<float> share(1);
      scene.segments.clear();
      scene.light().definition->transmission(scene.light(), seen.at.points, share);
      REQUIRE(scene.segments.size() == 1);
      const glm::dvec3 start = in_world(scene, time, scene.segments[0].first);
      const glm::dvec3 end = in_world(scene, time, scene.segments[0].second);
      CHECK(glm::distance(start, P_world) < 1e-5);
      const glm::dvec3 expected = parallel ? P_world + glm::normalize(from - to) : from;
      CHECK(glm::distance(end, expected) < 1e-5);
    }
  }
}

TEST_CASE("lights with extent, too, stay in the world while the camera moves", "[light]") {
  const glm::dmat4 from_light = glm::translate(glm::dmat4(1.0), glm::dvec3(0.2, 0.4, 1.0));
  for (const char* name : {"rectanglelight", "disclight", "spherelight", "domelight"}) {
    CAPTURE(name);
    MovingScene scene(call(name, {}, from_light), true, true);
    const auto seen_at = [&](float time) {
      const SeenPoint seen(scene, P_world, N_world, time);
      ShareSamples out;
      scene.segments.clear();
      const std::vector<glm::vec2> xi{{0.3f, 0.8f}};
      scene.light().definition->share_from(scene.light(), seen.at.points, xi,
                                           scene.bindings->light_services(), out);
      return out;
    };
    const glm::vec3 expected = seen_at(0.0f).share[0];
    REQUIRE(scene.segments.size() == 1);
    const glm::dvec3 end = in_world(scene, 0.0f, scene.segments[0].second);
    CHECK(expected.x > 0.0f);
    const float time = 1.0f;
    const glm::vec3 found = seen_at(time).share[0];
    REQUIRE(scene.segments.size() == 1);
    CHECK(glm::distance(found, expected) < 1e-4f);
    CHECK(glm::distance(in_world(scene, time, scene.segments[0].second), end) < 1e-4);
  }
}
