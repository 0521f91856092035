#include "engine/plan.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "dice/dice.h"
#include "engine/accuracy_target.h"
#include "engine/limits.h"
#include "hide/hide.h"
#include "scenes/scene_motion.h"
#include "shade/shade.h"

namespace tessera {
namespace {

/// Shadow maps are no textures: they are read without the image library.
bool names_a_texture(const ShaderCall& shader) {
  return std::any_of(shader.parameters.begin(), shader.parameters.end(), [](const Parameter& p) {
    return p.type == ValueType::string && p.name.find("name") != std::string::npos &&
           p.name != "shadowname" && !p.strings.empty() && !p.strings.front().empty();
  });
}

/// Of its shaders and of the lights that shine on it.
bool uses_textures(const Attributes& attributes, const Scene& scene) {
  return (attributes.surface && names_a_texture(*attributes.surface)) ||
         (attributes.displacement && names_a_texture(*attributes.displacement)) ||
         std::ranges::any_of(attributes.lights, [&](int light) {
           return names_a_texture(scene.lights[size_t(light)].shader);
         });
}

int checked(const char* what, int value, int low, int high) {
  if (value < low || value > high)
    throw Error(fmt::format("{} must lie between {} and {}, found {}", what, low, high, value));
  return value;
}

float parse_width(std::string_view text, const std::string& spec) {
  float width = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), width);
  if (error != std::errc() || end != text.data() + text.size() || !(width > 0) || width > 64)
    throw Error(fmt::format(
        "filter '{}': expected NAME or NAME:XxY with widths in pixels above 0 and up to 64", spec));
  return width;
}

/// Splits "name:XxY" into the plan's filter.
void set_filter(FramePlan& plan, const std::string& spec) {
  const size_t colon = spec.find(':');
  plan.filter = spec.substr(0, colon);
  if (colon == std::string::npos) return;
  const std::string_view widths = std::string_view(spec).substr(colon + 1);
  const size_t cross = widths.find('x');
  plan.filter_x_width = parse_width(widths.substr(0, cross), spec);
  plan.filter_y_width = cross == std::string_view::npos
                            ? plan.filter_x_width
                            : parse_width(widths.substr(cross + 1), spec);
}

/// "rgb", "a" and "z" first, then whatever the displays and the settings name.
std::vector<std::string> channel_groups_of(const Scene& scene, const Settings& settings) {
  std::vector<std::string> groups{"rgb", "a", "z"};
  const auto add = [&](const std::string& name) {
    if (std::find(groups.begin(), groups.end(), name) == groups.end()) groups.push_back(name);
  };
  for (const Display& display : scene.displays)
    for (const AovDefinition& aov : aov_registry())
      if (display.mode == aov.name) add(aov.name);
  for (const std::string& name : settings.aovs) add(find_aov(name).name);
  return groups;
}

void set_needs(FramePlan& plan, const Scene& scene, const CameraSettings& camera,
               const ShaderBindings& bindings) {
  plan.lens =
      camera.lens.has_value() && camera.lens->focal_length > 0 && camera.lens->f_stop < 1e30;
  plan.motion = shutter_opens(camera) && camera.camera_from_world.moves();
  const Attributes* last = nullptr;
  for (const Surface& surface : scene.surfaces) {
    plan.motion = plan.motion || (shutter_opens(camera) && surface_moves(surface));
    plan.transparency = plan.transparency || may_be_transparent(bindings, surface);
    // Surfaces in a row mostly share their attributes.
    if (surface.attributes.get() == last) continue;
    last = surface.attributes.get();
    plan.displacement = plan.displacement || last->displacement.has_value();
    plan.textures = plan.textures || uses_textures(*last, scene);
  }
  plan.area_lights = has_effect(bindings, RayEffect::shadow);
  plan.bounce = has_effect(bindings, RayEffect::bounce);
  plan.ray_tracing = wants_rays(bindings) && !scene.surfaces.empty();
}

/// Where they are not those of the plan; empty: they are.
std::string describe_samples(const AccuracyTarget& target) {
  if (!target.rounds.empty() || !target.passes.empty()) return "those of the frame repeated";
  if (!target.several_passes()) return "";
  const char* takes = !target.time_s ? "an error takes"
                      : target.error ? "an error or a time takes"
                                     : "a time takes";
  return fmt::format("as many as {}, up to {}", takes, target.max_samples);
}

/// A frame without distribution effects goes through no filter for them, whatever was asked for.
void set_reconstruction(FramePlan& plan, const Settings& settings) {
  constexpr const char* best_method = "wiener";
  constexpr int most_extra_samples = 100;
  const std::string asked = settings.reconstruct.value_or(
      plan.area_lights || plan.bounce ? best_method : plan.reconstruct);
  reconstruction_reach(asked);  // throws when there is no such method
  if (!plan.distribution().any()) return;
  plan.reconstruct = asked;
  // Hiders that prescribe the samples have no use for more of them in some pixels, and an error has
  // its own way to find these.
  const bool free_samples = plan.sample_tuples.kind == SampleTuples::Kind::free &&
                            !settings.error && settings.rounds.empty();
  if (plan.lens && plan.filters_distribution() && free_samples)
    plan.extra_samples = checked(
        "extra samples", settings.extra_samples.value_or(most_extra_samples), 0, max_extra_samples);
}

/// Of the whole frame: the most over its surfaces, so that nobody takes micropolygons for smaller
/// than they are.
float dicing_ratio(const Scene& scene, const Settings& settings) {
  float most = 0;
  for (const Surface& surface : scene.surfaces) {
    const Attributes& attributes = *surface.attributes;
    const float area = settings.dicing_rate.value_or(micropolygon_area(attributes));
    most = std::max(most, area / attributes.shading_rate);
  }
  return most > 0 && std::isfinite(most) ? most : 1.0f;
}

}  // namespace

FramePlan make_plan(const Scene& scene, const CameraSettings& camera, const Settings& settings,
                    const ShaderBindings& bindings) {
  FramePlan plan;
  set_needs(plan, scene, camera, bindings);

  const SceneOptions& options = scene.options;
  // Checked as a product in long: two large counts in a scene file must not overflow.
  const long scene_samples = long(options.x_samples) * long(options.y_samples);
  plan.samples_per_pixel =
      checked("samples per pixel",
              settings.samples_per_pixel.value_or(int(std::min(scene_samples, 1L << 30))), 1,
              max_samples_per_pixel);
  plan.samples_found = describe_samples(accuracy_target(settings));
  plan.bucket_size = checked(
      "bucket size", settings.bucket_size.value_or(options.bucket_size.value_or(plan.bucket_size)),
      1, max_bucket_size);
  plan.grid_size =
      checked("grid size", settings.grid_size.value_or(plan.grid_size), 1, max_grid_size);
  plan.dicing_ratio = dicing_ratio(scene, settings);
  plan.motion_factor = settings.motion_factor.value_or(plan.motion_factor);
  plan.focus_factor = settings.focus_factor.value_or(plan.focus_factor);
  if (settings.hider) plan.hider = *settings.hider;
  plan.sample_tuples = make_hider(plan.hider)->sample_tuples(plan.samples_per_pixel);
  if (settings.shading) plan.shading = *settings.shading;
  plan.filter_x_width = options.filter_x_width;
  plan.filter_y_width = options.filter_y_width;
  set_filter(plan, settings.filter.value_or(options.filter));
  set_reconstruction(plan, settings);
  plan.channel_groups = channel_groups_of(scene, settings);
  return plan;
}

std::vector<std::pair<std::string, std::string>> FramePlan::entries() const {
  const auto yes = [](bool b) { return std::string(b ? "yes" : "no"); };
  return {{"motion", yes(motion)},
          {"lens", yes(lens)},
          {"transparency", yes(transparency)},
          {"displacement", yes(displacement)},
          {"textures", yes(textures)},
          {"area_lights", yes(area_lights)},
          {"bounce", yes(bounce)},
          {"ray_tracing", yes(ray_tracing)},
          {"samples_per_pixel",
           samples_found.empty() ? std::to_string(samples_per_pixel) : samples_found},
          {"bucket_size", std::to_string(bucket_size)},
          {"grid_size", std::to_string(grid_size)},
          {"dicing_ratio", fmt::format("{}", dicing_ratio)},
          {"motion_factor", fmt::format("{}", motion_factor)},
          {"focus_factor", fmt::format("{}", focus_factor)},
          {"hider", hider},
          {"samples", to_string(sample_tuples)},
          {"shading", shading},
          {"reconstruct", reconstruct},
          {"extra_samples", std::to_string(extra_samples)},
          {"filter", fmt::format("{}:{}x{}", filter, filter_x_width, filter_y_width)},
          {"channels", fmt::format("{}", fmt::join(channel_groups, " "))}};
}

}  // namespace tessera
