// What the options of dicing do to a frame, and who goes before whom.

#include <limits>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/engine/render_text.h"

using namespace tessera;

namespace {

// A bilinear patch of about 60 x 60 pixels that moves by about 40, and is out of focus.
std::string moving_patch(const std::string& attributes) {
  return R"(Format 80 80 1  PixelSamples 2 2  Shutter 0 1  DepthOfField 1.4 0.6 1
            Projection "perspective" "fov" [90]  WorldBegin )" +
         attributes + R"(
            MotionBegin [0 1]
              Translate -0.5 0 0
              Translate 0.5 0 0
            MotionEnd
            Patch "bilinear" "P" [-0.75 -0.75 1.5  0.75 -0.75 1.5  -0.75 0.75 1.5  0.75 0.75 1.5]
            WorldEnd)";
}

uint64_t micropolygons(const std::string& attributes, const Settings& settings = {}) {
  for (const auto& [name, count] :
       render_text_frame(moving_patch(attributes), settings).statistics.counts)
    if (name == "micropolygons") return count;
  return 0;
}

const std::string no_motion = "GeometricApproximation \"motionfactor\" 0 ";
const std::string no_focus = "GeometricApproximation \"focusfactor\" 0 ";

}  // namespace

TEST_CASE("the command line goes before the scene, and the scene before the defaults") {
  const uint64_t full = micropolygons(no_motion + no_focus);
  Settings off;
  off.motion_factor = off.focus_factor = 0.0f;
  CHECK(micropolygons("", off) == full);
  CHECK(micropolygons("GeometricApproximation \"motionfactor\" 8", off) == full);
  CHECK(double(micropolygons("")) < 0.7 * double(full));

  Settings on;
  on.motion_factor = 1.2f;
  const uint64_t by_scene = micropolygons(no_focus + "GeometricApproximation \"motionfactor\" 1.2");
  CHECK(by_scene < full);
  CHECK(micropolygons(no_motion + no_focus, on) == by_scene);
}

TEST_CASE("a dicing rate changes micropolygons, and the surface's own yields to the frame's") {
  const std::string sharp = no_motion + no_focus;
  const uint64_t of_4 = micropolygons(sharp + "ShadingRate 4");
  CHECK(of_4 < micropolygons(sharp) / 3);
  CHECK(micropolygons(sharp + "Attribute \"dice\" \"rate\" 4") == of_4);
  Settings settings;
  settings.dicing_rate = 4.0f;
  CHECK(micropolygons(sharp, settings) == of_4);
  CHECK(micropolygons(sharp + "Attribute \"dice\" \"rate\" 0.5", settings) == of_4);
}

TEST_CASE("shading is told how much larger micropolygons are than its cells") {
  const auto ratio = [](const std::string& attributes, const Settings& settings) {
    Diagnostics diagnostics;
    SceneCollector sink;
    read_rib_text(moving_patch(attributes), "test.rib", sink, diagnostics);
    return plan_frame(*sink.scenes.at(0), settings, diagnostics).dicing_ratio;
  };
  Settings dicing, both;
  dicing.dicing_rate = both.dicing_rate = 16.0f;
  both.shading_rate = 2.0f;
  CHECK(ratio("", {}) == 1);
  CHECK(ratio("ShadingRate 4", {}) == 1);
  CHECK(ratio("ShadingRate 4", dicing) == 4);
  CHECK(ratio("ShadingRate 4", both) == 8);
  CHECK(ratio("ShadingRate 0.5 Attribute \"dice\" \"rate\" 2", {}) == 4);
}

TEST_CASE("rates and factors that are no areas are refused") {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const float bad : {0.0f, -1.0f, nan}) {
    Settings settings;
    settings.dicing_rate = bad;
    CHECK_THROWS_WITH(micropolygons("", settings), Catch::Contains("dicing rate must be above 0") &&
                                                       Catch::Contains(fmt::format("{}", bad)));
  }
  for (const float bad : {-1.0f, nan}) {
    Settings settings;
    settings.motion_factor = bad;
    CHECK_THROWS_WITH(micropolygons("", settings), Catch::Contains("motion factor"));
    settings = {};
    settings.focus_factor = bad;
    CHECK_THROWS_WITH(micropolygons("", settings), Catch::Contains("focus factor"));
  }
}
