#include "shade/bounce_rays.h"
#include "shade/hemisphere.h"

namespace tessera {
namespace {

void share_from(const BoundLight& light, const ShadingPoints& points, std::span<const glm::vec2> xi,
                const LightServices& services, ShareSamples& out) {
  const auto ask = [&](const Rays& rays) {
    BounceArrivals arrivals;
    follow_rays(rays, services, arrivals);
    return RayShares{std::move(arrivals.radiance), std::move(arrivals.distance)};
  };
  hemisphere_shares(light, points, xi, services, ask, out);
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
