#include "shade/extended_light.h"
#include "shade/light_extent.h"
#include "shade/mathematics.h"

namespace tessera {
namespace {

LightExtent measure(const BoundParameters& parameters, const glm::dmat4& camera_from_light) {
  const double radius = positive_size(parameters, "radius");
  LightExtent extent = flat_extent({radius, radius}, pi, camera_from_light);
  extent.round = true;
  return extent;
}

void illuminate_from(const BoundLight& light, const ShadingPoints& points,
                     std::span<const glm::vec2> xi, PlaceSamples& out) {
  illuminate_flat(light, points, xi, disc_from_square, out);
}

}  // namespace

LightDefinition light_disclight() {
  return {.name = "disclight",
          .help = "a disc in the xy plane of the light's space that shines along +z",
          .parameters = with_extent_parameters({scalar_parameter("radius", 1.0f, "of the disc")}),
          .illuminate_from = illuminate_from,
          .measure = measure,
          .share_from = share_from_extent};
}

}  // namespace tessera
