#pragma once
/// What lights with extent have in common: parameters, the places they are summed over, and samples
/// of them with the effect coordinates of shade/effects.h.

#include "shade/light.h"

namespace tessera {

/// `own` followed by intensity, lightcolor, samples and shadowrate.
std::vector<ParameterDeclaration> with_extent_parameters(std::vector<ParameterDeclaration> own);

/// intensity * lightcolor of a light that declares those: the radiance it sends out.
glm::vec3 radiance_of(const BoundParameters& parameters);

/// `count` places in [0, 1)^2, at least 1: a Hammersley set with every other digit of y turned over,
/// each point in the middle of its stratum along x and along y. Left as they are, digits tie y to
/// x, and sums over the set are off by several percent of what changes along a diagonal
/// (J. Halton and S. Zaremba, "The extreme and L2 discrepancies of some plane sets", 1969).
std::vector<glm::vec2> spread_places(int count);

/// The number of places that a light's "samples" asks for, rounded. Throws Error outside of 1 to
/// 4096.
int place_count(const BoundParameters& parameters);
/// Where each sample casts a ray of its own, the unblocked light is summed over this many times as
/// many places.
inline constexpr int term_places_scale = 4;

/// Finite lights: sets entry i of `out` from the place `at` with unit `normal`, a part of a light
/// of that area. Cl is radiance * cosine at the light * area / (pi d^2), so that the mean of Cl *
/// max(0, N . L) over places is what a surface of albedo 1 sends back. Very near the light that has
/// no bound, while what the light adds has: one of n places counts for at most 2 n times the
/// radiance. Both sides of the light shine if `double_sided`.
struct LightPlace {
  glm::vec3 at, normal;
};
void set_place(const BoundLight& light, const glm::vec3& P, const LightPlace& place,
               const glm::vec3& radiance, bool double_sided, int i, PlaceSamples& out);

/// LightDefinition::illuminate_from of flat lights that shine to one side: place_of(xi) gives a
/// place in units of the extent's first two half axes.
template <class PlaceOf>
void illuminate_flat(const BoundLight& light, const ShadingPoints& points,
                     std::span<const glm::vec2> xi, const PlaceOf& place_of, PlaceSamples& out) {
  const glm::vec3 radiance = radiance_of(light.parameters);
  const LightExtent& extent = light.extent;
  for (int i = 0; i < points.count; ++i) {
    const glm::vec2 at = place_of(xi[size_t(i)]);
    const glm::vec3 place = extent.centre + at.x * extent.half_axes[0] + at.y * extent.half_axes[1];
    set_place(light, points.P[i], {place, extent.normal}, radiance, false, i, out);
  }
}

/// LightDefinition::share_from of every light that has illuminate_from() and a BoundLight::extent.
///
/// share = V * w, with V the share of light that gets from the place to the point and w = Cl cos at
/// the place over the mean of Cl cos over BoundLight::places. slope is d1 / d2 - 1, d1 the distance
/// from point to place and d2 that from blocker to place, at most 1e6; for infinite lights the
/// distance from point to blocker. Normals are turned towards the eye first.
void share_from_extent(const BoundLight& light, const ShadingPoints& points,
                       std::span<const glm::vec2> xi, const LightServices& services,
                       ShareSamples& out);

}  // namespace tessera
