// The hook that changes a frame's plan for measuring.

#include <catch2/catch.hpp>

#include "tests/engine/differing_values.h"
#include "tests/engine/render_text.h"
#include "tests/engine/scene_text.h"

using namespace tessera;

namespace {

FrameResult render_revised(const std::function<void(FramePlan&)>& revise) {
  Diagnostics diagnostics;
  SceneCollector sink;
  read_rib_text(sphere_scene(), "test.rib", sink, diagnostics);
  FrameControl control;
  control.revise_plan = revise;
  return render_frame(*sink.scenes.at(0), {}, diagnostics, control);
}

std::string planned(const FrameResult& frame, const std::string& name) {
  for (const auto& [entry, value] : frame.statistics.plan)
    if (entry == name) return value;
  FAIL("no entry " << name << " in the plan");
  return "";
}

}  // namespace

TEST_CASE("a plan is revised after it is made, and the frame follows it") {
  bool was_moving = true;
  const FrameResult frame = render_revised([&](FramePlan& plan) {
    was_moving = plan.motion;
    plan.motion = true;
    plan.samples_per_pixel = 9;
  });
  CHECK_FALSE(was_moving);
  CHECK(planned(frame, "motion") == "yes");
  CHECK(planned(frame, "samples_per_pixel") == "9");
  uint64_t samples = 0;
  for (const auto& [name, value] : frame.statistics.counts)
    if (name == "samples") samples = value;
  CHECK(samples >= 9u * 32 * 24);
}

TEST_CASE("features that a frame does not need leave its image as it is") {
  const Image image = render_text(sphere_scene());
  const auto with = [&](const std::function<void(FramePlan&)>& revise) {
    return render_revised(revise).image;
  };
  CHECK(differing_values(with(nullptr), image) == 0);
  CHECK(differing_values(with([](FramePlan& p) { p.transparency = true; }), image) == 0);
  CHECK(differing_values(with([](FramePlan& p) { p.ray_tracing = true; }), image) == 0);
}

TEST_CASE("what the revised plan cannot do is an error") {
  CHECK_THROWS_AS(render_revised([](FramePlan& p) { p.reconstruct = "none such"; }), Error);
}
