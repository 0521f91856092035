/// Motion blocks: keys in shutter time, against the piecewise linear function they stand for.

#include "rib_test_utils.h"

using namespace tessera;
using namespace tessera::test;

namespace {

ReadResult read_moving(const std::string& options, const std::string& world) {
  return read_text(options + " WorldBegin " + world + " WorldEnd");
}

const std::string sphere = " Sphere 1 -1 1 360 ";

double x_at(const MovingTransform& transform, float t) { return transform.at(t)[3].x; }

}  // namespace

TEST_CASE("keys are cut to the shutter") {
  // x(time) = 10 time on [0, 1], held outside.
  const std::string moving =
      "MotionBegin [0 1] Translate 0 0 0 Translate 10 0 0 MotionEnd" + sphere;
  struct Case {
    const char* shutter;
    double x_open, x_middle, x_close;
  };
  for (const Case& c : {Case{"Shutter 0 1", 0, 5, 10}, Case{"Shutter .25 .75", 2.5, 5, 7.5},
                        Case{"Shutter -1 1", 0, 0, 10}, Case{"Shutter 0 2", 0, 10, 10},
                        Case{"Shutter .5 .5", 5, 5, 5}, Case{"", 0, 0, 0},
                        Case{"Shutter 2 3", 10, 10, 10}, Case{"Shutter -.5 1.5", 0, 5, 10}}) {
    CAPTURE(c.shutter);
    const auto result = read_moving(c.shutter, moving);
    const MovingTransform& keyed = result.scene().surfaces.at(0).world_from_object;
    CHECK(x_at(keyed, 0) == Approx(c.x_open).margin(1e-12));
    CHECK(x_at(keyed, .5f) == Approx(c.x_middle).margin(1e-12));
    CHECK(x_at(keyed, 1) == Approx(c.x_close).margin(1e-12));
    CHECK(keyed.moves() == (c.x_open != c.x_close));
    CHECK(keyed.times().front() == 0.0f);
    if (keyed.moves()) CHECK(keyed.times().back() == 1.0f);
  }
}

TEST_CASE("several keys, and blocks on top of each other") {
  const auto result =
      read_moving("Shutter 0 4",
                  "MotionBegin [0 1 4] Translate 0 0 0 Translate 4 0 0 Translate 1 0 0 MotionEnd"
                  "  MotionBegin [0 2] Scale 1 1 1 Scale 3 3 3 MotionEnd  Translate 1 0 0" +
                      sphere);
  const MovingTransform& keyed = result.scene().surfaces.at(0).world_from_object;
  CHECK(keyed.times() == std::vector<float>{0, .25f, .5f, 1});
  // x(time) = shift(time) + scale(time), exact at the keys of both.
  CHECK(x_at(keyed, 0) == Approx(0 + 1));
  CHECK(x_at(keyed, .25f) == Approx(4 + 2));
  CHECK(x_at(keyed, .5f) == Approx(3 + 3));
  CHECK(x_at(keyed, 1) == Approx(1 + 3));
}

TEST_CASE("a moving camera, and what hangs on it") {
  const auto result = read_text(
      "Shutter 0 1 MotionBegin [0 1] Translate 0 0 5 Translate 2 0 5 MotionEnd "
      "LightSource \"pointlight\" 1 CoordinateSystem \"rig\" WorldBegin CoordSysTransform "
      "\"camera\"" +
      sphere + "WorldEnd");
  const Scene& scene = result.scene();
  CHECK(scene.camera.camera_from_world.moves());
  CHECK(x_at(scene.camera.camera_from_world, 1) == 2);
  // Declared in the camera's own moving space, which the world is: they stand still in it.
  CHECK_FALSE(scene.lights.at(0).shader.world_from_shader.moves());
  CHECK_FALSE(scene.coordinate_systems.at("rig").moves());
}

TEST_CASE("shapes in motion blocks") {
  const auto result = read_moving(
      "Shutter 0 1",
      "MotionBegin [0 2] Patch \"bilinear\" \"P\" [0 0 0 1 0 0 0 1 0 1 1 0] \"Cs\" [1 0 0 0 1 0 0 "
      "0 "
      "1 1 1 1] Patch \"bilinear\" \"P\" [0 0 4 1 0 4 0 1 4 1 1 4] \"Cs\" [1 0 0 0 1 0 0 0 1 1 1 "
      "1] "
      "MotionEnd MotionBegin [0 .5 1] Sphere 1 -1 1 360 Sphere 3 -3 3 360 Sphere 5 -5 5 180 "
      "MotionEnd");
  REQUIRE(result.scene().surfaces.size() == 2);
  const Geometry& patch = *result.scene().surfaces[0].geometry;
  CHECK(patch.key_times == std::vector<float>{0, 1});
  REQUIRE(patch.P_object.size() == 2);
  CHECK(patch.P_object[1][3] == glm::vec3(1, 1, 2));
  CHECK(patch.primvars.size() == 1);
  const Geometry& quadric = *result.scene().surfaces[1].geometry;
  CHECK(quadric.key_times == std::vector<float>{0, .5f, 1});
  CHECK(std::get<Quadric>(quadric.shape).parameters[2] == std::vector<double>{5, -5, 5, 180});
  const auto still = read_moving("", "MotionBegin [0 1] Disk 0 1 360 Disk 1 1 360 MotionEnd");
  CHECK(still.scene().surfaces[0].geometry->key_times == std::vector<float>{0});
}

TEST_CASE("moving NURBS weights fill in where one key has none") {
  const std::string head = "NuPatch 2 2 [0 0 1 1] 0 1 2 2 [0 0 1 1] 0 1 ";
  const auto result =
      read_moving("Shutter 0 1", "MotionBegin [0 1] " + head + "\"P\" [0 0 0 1 0 0 0 1 0 1 1 0] " +
                                     head + "\"Pw\" [0 0 0 1 3 0 0 3 0 1 0 1 1 1 0 1] MotionEnd");
  const auto& nurbs = std::get<NurbsPatch>(result.scene().surfaces.at(0).geometry->shape);
  REQUIRE(nurbs.weights.size() == 2);
  CHECK(nurbs.weights[0] == std::vector<float>{1, 1, 1, 1});
  CHECK(nurbs.weights[1] == std::vector<float>{1, 3, 1, 1});
}

TEST_CASE("attributes in motion blocks keep their first value, with a warning") {
  const auto result =
      read_moving("Shutter 0 1", "MotionBegin [0 1] Color 1 0 0 Color 0 1 0 MotionEnd" + sphere);
  CHECK(result.scene().surfaces[0].attributes->color == glm::vec3(1, 0, 0));
  CHECK(result.warnings.size() == 1);
}

TEST_CASE("malformed motion blocks are refused") {
  const std::vector<std::pair<const char*, const char*>> table = {
      {"MotionBegin [0 1] Translate 1 0 0 MotionEnd", "has 2 times, found 1 calls"},
      {"MotionBegin [0 1] Translate 1 0 0 Translate 1 0 0 Translate 1 0 0 MotionEnd", "more calls"},
      {"MotionBegin [1 0] Translate 1 0 0 Translate 1 0 0 MotionEnd", "ascending motion times"},
      {"MotionBegin [0 0] Translate 1 0 0 Translate 1 0 0 MotionEnd", "ascending motion times"},
      {"MotionBegin [] MotionEnd", "at least one motion time"},
      {"MotionBegin [0 1] Translate 1 0 0 Sphere 1 -1 1 360 MotionEnd", "mixes transforms"},
      {"MotionBegin [0 1] Translate 1 0 0 Identity MotionEnd", "both set and concatenate"},
      {"MotionBegin [0 1] Sphere 1 -1 1 360 Disk 0 1 360 MotionEnd", "in points only"},
      {"MotionBegin [0 1] AttributeBegin", "AttributeBegin between MotionBegin"},
      {"MotionBegin [0 1] MotionBegin [0 1]", "MotionBegin between MotionBegin"},
      {"MotionBegin [0 1] Polygon \"P\" [0 0 0 1 0 0 1 1 0] Polygon \"P\" [0 0 0 1 0 0 1 1 0 0 1 "
       "0] "
       "MotionEnd",
       "kind, counts or indices"},
      {"MotionEnd", "expected WorldEnd"}};
  for (const auto& [text, message] : table) {
    CAPTURE(text);
    CHECK_THAT(error_in_world(std::string("\n") + text),
               Contains("test.rib:2: ") &&
                   Contains(std::string(message) == "in points only" ? "points only" : message));
  }
}
