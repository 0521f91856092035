#include "shade/extended_light.h"
#include "shade/light_extent.h"

namespace tessera {
namespace {

LightExtent measure(const BoundParameters& parameters, const glm::dmat4& camera_from_light) {
  const double width = positive_size(parameters, "width");
  const double height = positive_size(parameters, "height");
  return flat_extent({0.5 * width, 0.5 * height}, 4.0, camera_from_light);
}

void illuminate_from(const BoundLight& light, const ShadingPoints& points,
                     std::span<const glm::vec2> xi, PlaceSamples& out) {
  illuminate_flat(
      light, points, xi, [](const glm::vec2& square) { return 2.0f * square - 1.0f; }, out);
}

}  // namespace

LightDefinition light_rectanglelight() {
  return {.name = "rectanglelight",
          .help = "a rectangle in the xy plane of the light's space that shines along +z",
          .parameters = with_extent_parameters({scalar_parameter("width", 1.0f, "along x"),
                                                scalar_parameter("height", 1.0f, "along y")}),
          .illuminate_from = illuminate_from,
          .measure = measure,
          .share_from = share_from_extent};
}

}  // namespace tessera
