#pragma once
/// Follows rays to the light that surfaces send back along them.

#include "shade/light.h"
#include "shade/ray_tracer.h"

namespace tessera {

/// What rays bring, one entry a ray.
struct BounceArrivals {
  Vec3Array radiance;           ///< of all that is met, seen through what lies in front of it
  std::vector<float> distance;  ///< of the first surface; infinite: none
};

/// Surfaces whose attributes make them transparent let rays through, at most 16 of them one after
/// the other. Black without RayTracer or BounceRadiance. Counts the rays.
void follow_rays(const Rays& rays, const LightServices& services, BounceArrivals& out);

}  // namespace tessera
