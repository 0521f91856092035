#include <cmath>

#include "shade/hemisphere.h"
#include "shade/shade.h"

namespace tessera {
namespace {

void share_from(const BoundLight& light, const ShadingPoints& points, std::span<const glm::vec2> xi,
                const LightServices& services, ShareSamples& out) {
  out.reset(points.count);
  const Rays rays = hemisphere_rays(light, points, xi, services);
  const RayTracer* tracer = light.ray_traced ? services.rays : nullptr;
  RayShadows shadows;
  if (tracer) {
    tracer->shadow(rays, shadows);
    services.counters->rays += uint64_t(rays.count());
  }
  for (int i = 0; i < points.count; ++i) {
    const size_t k = size_t(i);
    out.share.set(i, glm::vec3(tracer ? shadows.share[k] : 1.0f));
    if (tracer && std::isfinite(shadows.distance[k])) out.slope[k] = shadows.distance[k];
  }
  if (services.camera) fill_hemisphere_coordinates(*services.camera, rays, points.N, out);
}

}  // namespace

/// Ambient occlusion, weighted by the cosine (S. Zhukov, A. Iones, G. Kronin, "An ambient light
/// illumination model", 1998, with an obscurance that is 0 or 1).
LightDefinition light_occlusionlight() {
  return {.name = "occlusionlight",
          .help = "ambient light, less the share of directions in which something is near",
          .parameters = hemisphere_parameters(),
          .ambient = true,
          .hemisphere = true,
          .illuminate = illuminate_hemisphere,
          .share_from = share_from,
          .effect = RayEffect::bounce};
}

}  // namespace tessera
