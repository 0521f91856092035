#include "shade/hemisphere.h"
#include "shade/shade.h"

namespace tessera {
namespace {

void share_from(const BoundLight& light, const ShadingPoints& points, std::span<const glm::vec2> xi,
                const LightServices& services, ShareSamples& out) {
  const auto ask = [&](const Rays& rays) {
    RayShares found{Vec3Array(rays.count()), {}};
    RayShadows shadows;
    const RayTracer* tracer = light.ray_traced ? services.rays : nullptr;
    if (tracer) {
      tracer->shadow(rays, shadows);
      services.counters->rays += uint64_t(rays.count());
      found.distance = std::move(shadows.distance);
    }
    for (int i = 0; i < rays.count(); ++i)
      found.share.set(i, glm::vec3(tracer ? shadows.share[size_t(i)] : 1.0f));
    return found;
  };
  hemisphere_shares(light, points, xi, services, ask, out);
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
