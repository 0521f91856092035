// The plan says what is so.

#include <catch2/catch.hpp>

#include "engine/frame.h"
#include "tests/engine/render_text.h"
#include "tests/engine/scene_text.h"

using namespace tessera;
using Catch::Matchers::Contains;

namespace {

FramePlan plan_of(const std::string& rib, const Settings& settings = {}) {
  Diagnostics diagnostics;
  SceneCollector sink;
  read_rib_text(rib, "test.rib", sink, diagnostics);
  return plan_frame(*sink.scenes.front(), settings, diagnostics);
}

std::string entry(const FramePlan& plan, std::string_view name) {
  for (const auto& [key, value] : plan.entries())
    if (key == name) return value;
  throw Error(fmt::format("no entry {}", name));
}

std::string lit_by(const std::string& light) {
  return sphere_camera() + "WorldBegin\nLightSource " + light +
         "\nSurface \"matte\"\nSphere 1 -1 1 360\nWorldEnd\n";
}

}  // namespace

TEST_CASE("factors of blur are those that the settings ask for") {
  CHECK(plan_of(sphere_scene()).motion_factor == 2);
  CHECK(plan_of(sphere_scene()).focus_factor == 8);
  Settings settings;
  settings.motion_factor = 0.0f, settings.focus_factor = 3.0f;
  CHECK(entry(plan_of(sphere_scene(), settings), "motion_factor") == "0");
  CHECK(entry(plan_of(sphere_scene(), settings), "focus_factor") == "3");
}

TEST_CASE("extra samples are those of frames with as many samples in all pixels besides") {
  CHECK(plan_of(rays_scene()).extra_samples == 100);
  Settings time;
  time.time_s = 1;
  CHECK(plan_of(rays_scene(), time).extra_samples == 100);
  Settings error;
  error.error = 0.1;
  CHECK(plan_of(rays_scene(), error).extra_samples == 0);
  Settings rounds;
  rounds.rounds = {2, 4};
  CHECK(plan_of(rays_scene(), rounds).extra_samples == 0);
}

TEST_CASE("samples per pixel that are found are no number of the scene's") {
  const auto samples = [](auto change) {
    Settings settings;
    change(settings);
    return entry(plan_of(sphere_scene(), settings), "samples_per_pixel");
  };
  CHECK(samples([](Settings&) {}) == "4");
  CHECK(samples([](Settings& s) { s.error = 0.1; }) == "as many as an error takes, up to 1024");
  CHECK(samples([](Settings& s) { s.time_s = 3, s.max_samples = 64; }) ==
        "as many as a time takes, up to 64");
  CHECK_THAT(samples([](Settings& s) { s.error = 0.1, s.time_s = 3; }),
             Contains("an error or a time"));
  CHECK_THAT(samples([](Settings& s) { s.passes = {2, 3}; }), Contains("repeated"));
  CHECK_THAT(samples([](Settings& s) { s.rounds = {2, 3}; }), Contains("repeated"));
}

TEST_CASE("textures are those of lights that shine, too, and shadow maps are none") {
  const std::string dome = "\"domelight\" 1 \"texturename\" [\"sky.exr\"]";
  CHECK(plan_of(lit_by(dome)).textures);
  CHECK_FALSE(plan_of(lit_by("\"domelight\" 1")).textures);
  CHECK_FALSE(plan_of(lit_by("\"domelight\" 1 \"texturename\" [\"\"]")).textures);
  CHECK_FALSE(plan_of(lit_by(dome + "\nIlluminate 1 0")).textures);
  CHECK_FALSE(plan_of(lit_by("\"spotlight\" 1 \"shadowname\" [\"map.shd\"]")).textures);
}

TEST_CASE("a frame of nothing took time to set up") {
  const FrameResult frame = render_text_frame(sphere_camera() + "WorldBegin\nWorldEnd\n");
  for (const auto& [name, seconds] : frame.statistics.times_s)
    if (name == "setup_s") CHECK(seconds > 0);
}
