#pragma once
/// Lights that come from all directions over a surface: sampled one direction a point, with the
/// density of the cosine to the normal.

#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "shade/light.h"
#include "shade/ray_tracer.h"

namespace tessera {

/// intensity, lightcolor, maxdistance, samples and shadowrate.
std::vector<ParameterDeclaration> hemisphere_parameters();

/// LightDefinition::illuminate of lights that declare those: intensity * lightcolor from all
/// around.
void illuminate_hemisphere(const BoundParameters& parameters, const ShadingPoints& points,
                           LightSamples& out);

/// A unit direction over the surface with unit normal N: the disc of the concentric map (P.
/// Shirley, K. Chiu 1997) lifted onto the hemisphere (J. Malley's method), whose density is cosine
/// / pi for uniform xi. Zero for a normal that is not a direction.
glm::vec3 cosine_direction(const glm::vec3& N, const glm::vec2& xi);

/// Rays from the points along cosine_direction(), as far as the light's maxdistance (world units;
/// NaN stands for no limit) at shutter open.
Rays hemisphere_rays(const BoundLight& light, const ShadingPoints& points,
                     std::span<const glm::vec2> xi, const LightServices& services);

/// Fills y and extent of `out` for rays from points with normals N. What a ray meets at distance d
/// lies d times the tangential part of the ray's direction away from the point, along the surface:
/// that part is y, measured in the pixels that the unit disc of the tangent plane spans (extent),
/// and d is the slope (s = z in L. Wu et al. 2017, section 3; there for one reflector at depth z).
/// Zero where a point has no place on the raster.
void fill_hemisphere_coordinates(const Camera& camera, const Rays& rays, const Vec3Input& N,
                                 ShareSamples& out);

/// What asking for rays finds, one entry a ray.
struct RayShares {
  Vec3Array share;              ///< as in ShareSamples
  std::vector<float> distance;  ///< of what is met first; infinite: nothing. Empty: not known
};

/// LightDefinition::share_from of these lights. ask(rays) gives the RayShares of rays from the
/// points, whose distances become slopes.
template <class Ask>
void hemisphere_shares(const BoundLight& light, const ShadingPoints& points,
                       std::span<const glm::vec2> xi, const LightServices& services, const Ask& ask,
                       ShareSamples& out) {
  out.reset(points.count);
  const Rays rays = hemisphere_rays(light, points, xi, services);
  RayShares found = ask(rays);
  out.share = std::move(found.share);
  for (size_t i = 0; i < found.distance.size(); ++i)
    if (std::isfinite(found.distance[i])) out.slope[i] = found.distance[i];
  if (services.camera) fill_hemisphere_coordinates(*services.camera, rays, points.N, out);
}

/// The mean share of a distributed light over `places` in [0, 1)^2, the same at every point, with
/// normals N of `points` on the side that is lit. Resizes `out`. No places: zero.
void mean_share(const BoundLight& light, const ShadingPoints& points,
                std::span<const glm::vec2> places, const LightServices& services, Vec3Array& out);

}  // namespace tessera
