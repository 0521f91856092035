#include <cmath>

#include "shade/bounce_rays.h"
#include "shade/hemisphere.h"

namespace tessera {
namespace {

void share_from(const BoundLight& light, const ShadingPoints& points, std::span<const glm::vec2> xi,
                const LightServices& services, ShareSamples& out) {
  out.reset(points.count);
  const Rays rays = hemisphere_rays(light, points, xi, services);
  BounceArrivals arrivals;
  follow_rays(rays, services, arrivals);
  for (int i = 0; i < points.count; ++i) {
    const float distance = arrivals.distance[size_t(i)];
    out.share.set(i, arrivals.radiance[i]);
    if (std::isfinite(distance)) out.slope[size_t(i)] = distance;
  }
  if (services.camera) fill_hemisphere_coordinates(*services.camera, rays, points.N, out);
}

}  // namespace

/// Final gathering of one bounce: with cosine-weighted directions, the mean of the radiance met is
/// what a white diffuse surface sends back.
LightDefinition light_indirectlight() {
  return {.name = "indirectlight",
          .help = "light that other surfaces send on, once, diffusely",
          .parameters = hemisphere_parameters(),
          .hemisphere = true,
          .illuminate = illuminate_hemisphere,
          .share_from = share_from,
          .effect = RayEffect::bounce};
}

}  // namespace tessera
