#include <algorithm>
#include <cmath>

#include "shade/extended_light.h"
#include "shade/mathematics.h"

namespace tessera {
namespace {

LightExtent measure(const BoundParameters&, const glm::dmat4&) {
  return {.half_axes = {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1)},
          .round = true,
          .infinite = true};
}

/// Directions are spread over the hemisphere about N with the density of the cosine, so that each
/// counts the same for a diffuse surface and Cl carries 1 / cosine.
void illuminate_from(const BoundLight& light, const ShadingPoints& points,
                     std::span<const glm::vec2> xi, PlaceSamples& out) {
  const glm::vec3 radiance = radiance_of(light.parameters);
  for (int i = 0; i < points.count; ++i) {
    const glm::vec3 N = points.N[i];
    if (N == glm::vec3(0.0f)) continue;
    const glm::vec2 disc = disc_from_square(xi[size_t(i)]);
    const float cosine = std::sqrt(std::max(1e-6f, 1.0f - glm::dot(disc, disc)));
    const auto [x, y] = tangents(glm::dvec3(N));
    const glm::vec3 tangent = disc.x * glm::vec3(x) + disc.y * glm::vec3(y);
    const glm::vec3 L = unit_or_zero(tangent + cosine * N);
    out.arriving.L.set(i, L);
    out.arriving.Cl.set(i, radiance / std::max(glm::dot(N, L), 1e-3f));
    out.towards.set(i, L);
    out.offset.set(i, tangent);
  }
}

}  // namespace

LightDefinition light_domelight() {
  return {.name = "domelight",
          .help = "light from infinitely far away, all round",
          .parameters = with_extent_parameters({}),
          .illuminate_from = illuminate_from,
          .measure = measure,
          .share_from = share_from_extent};
}

}  // namespace tessera
