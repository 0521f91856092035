#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "dice/whole_scene.h"
#include "rays/ray_module.h"
#include "rays/rays.h"

namespace tessera {

namespace {

/// Area of a micropolygon that rays meet over that of one that is seen (docs/rays.md).
constexpr float rate_scale = 4.0f;

/// Whether Attribute "visibility" "transmission" is off, as a number or in words.
bool ignores_shadow_rays(const Attributes& attributes) {
  const auto given = attributes.user.find("visibility:transmission");
  if (given == attributes.user.end()) return false;
  const Parameter& value = given->second;
  if (!value.numbers.empty()) return value.numbers.front() == 0;
  if (value.strings.empty()) return false;
  const std::string& word = value.strings.front();
  return word == "0" || word == "off" || word == "none" || word == "transparent";
}

float share_that_passes(const Attributes& attributes) {
  if (ignores_shadow_rays(attributes)) return 1;
  float opacity = 0;
  for (int c = 0; c < 3; ++c) {
    const float channel = attributes.opacity[c];
    opacity += std::isnan(channel) ? 1.0f : std::clamp(channel, 0.0f, 1.0f);
  }
  return std::clamp(1 - opacity / 3, 0.0f, 1.0f);
}

DiceSettings dice_settings(const RaySettings& settings) {
  DiceSettings dice;
  dice.max_grid_size = settings.max_grid_size;
  dice.dicing_rate = settings.dicing_rate;
  // A rate that is given is meant as it stands.
  if (!settings.dicing_rate) dice.shading_rate_scale = rate_scale;
  dice.displacer = settings.displacer;
  dice.wants_primvar = settings.wants_primvar;
  return dice;
}

}  // namespace

std::shared_ptr<const RayTracer> make_ray_tracer(const Scene& scene, const Camera& camera,
                                                 const RaySettings& settings,
                                                 Diagnostics& diagnostics) {
  if (scene.surfaces.empty()) return nullptr;
  RayScene rays;
  rays.threads = std::max(1, settings.threads);
  tbb::task_arena arena(rays.threads);
  arena.execute([&] {
    rays.grids = dice_whole_scene(scene, camera, dice_settings(settings), diagnostics);
    rays.near.resize(rays.grids.size());
    tbb::parallel_for(size_t(0), rays.grids.size(),
                      [&](size_t g) { rays.near[g] = near_ranges(*rays.grids[g]); });
  });
  for (const auto& grid : rays.grids) rays.passing.push_back(share_that_passes(grid->attributes()));
  return make_module_ray_tracer(std::move(rays));
}

}  // namespace tessera
