#include "engine/overrides.h"

#include <map>

#include <fmt/format.h>

#include "base/error.h"

namespace tessera {
namespace {

void check_area(const char* what, std::optional<float> area) {
  if (area && (!(*area > 0) || *area > 1e12f))
    throw Error(fmt::format("{} must be above 0 pixels^2 and at most 1e12, found {}", what, *area));
}

void check_factor(const char* what, std::optional<float> factor) {
  if (factor && (!(*factor >= 0) || *factor > 1e12f))
    throw Error(fmt::format("{} must lie between 0 and 1e12, found {}", what, *factor));
}

void replace_rates(Scene& scene, const Settings& settings) {
  // Surfaces that share attributes go on sharing them: shaders are bound once per Attributes.
  std::map<const Attributes*, std::shared_ptr<const Attributes>> replaced;
  for (Surface& surface : scene.surfaces) {
    auto& slot = replaced[surface.attributes.get()];
    if (!slot) {
      auto copy = std::make_shared<Attributes>(*surface.attributes);
      if (settings.shading_rate) copy->shading_rate = *settings.shading_rate;
      if (settings.motion_factor) copy->motion_factor = settings.motion_factor;
      if (settings.focus_factor) copy->focus_factor = settings.focus_factor;
      slot = std::move(copy);
    }
    surface.attributes = slot;
  }
}

}  // namespace

Scene apply_overrides(const Scene& scene, const Settings& settings) {
  Scene changed = scene;
  if (settings.crop) changed.camera.crop = *settings.crop;
  if (settings.x_resolution) changed.camera.x_resolution = *settings.x_resolution;
  if (settings.y_resolution) changed.camera.y_resolution = *settings.y_resolution;
  check_area("shading rate", settings.shading_rate);
  check_area("dicing rate", settings.dicing_rate);
  check_area("ray dicing rate", settings.ray_dicing_rate);
  check_factor("motion factor", settings.motion_factor);
  check_factor("focus factor", settings.focus_factor);
  if (settings.shading_rate || settings.motion_factor || settings.focus_factor)
    replace_rates(changed, settings);
  return changed;
}

}  // namespace tessera
