#include "engine/overrides.h"

#include <map>

#include <fmt/format.h>

#include "base/error.h"

namespace tessera {
namespace {

void replace_shading_rate(Scene& scene, float shading_rate) {
  if (!(shading_rate > 0) || shading_rate > 1e12f)
    throw Error(fmt::format("shading rate must be above 0 pixels^2, found {}", shading_rate));
  // Surfaces that share attributes go on sharing them: shaders are bound once per Attributes.
  std::map<const Attributes*, std::shared_ptr<const Attributes>> replaced;
  for (Surface& surface : scene.surfaces) {
    auto& slot = replaced[surface.attributes.get()];
    if (!slot) {
      auto copy = std::make_shared<Attributes>(*surface.attributes);
      copy->shading_rate = shading_rate;
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
  if (settings.shading_rate) replace_shading_rate(changed, *settings.shading_rate);
  return changed;
}

}  // namespace tessera
