#include "shade/light_shadows.h"

namespace tessera {
namespace {

void illuminate(const BoundParameters& parameters, const ShadingPoints& points, LightSamples& out) {
  const glm::vec3 from = parameters.vec3("from");
  const glm::vec3 color = parameters.scalar("intensity") * parameters.vec3("lightcolor");
  for (int i = 0; i < points.count; ++i) {
    const glm::vec3 towards = from - points.P[i];
    const float distance = glm::length(towards);
    if (!(distance > 0.0f)) continue;  // the light sits on the point: no direction
    out.L.set(i, towards / distance);
    out.Cl.set(i, color / distance / distance);  // twice: the square of a tiny distance underflows
  }
}

}  // namespace

/// RenderMan Interface 3.2, appendix A.2.3: falls off with the square of the distance.
LightDefinition light_pointlight() {
  return {.name = "pointlight",
          .help = "light from a point in all directions, falling off with distance squared",
          .parameters =
              with_shadow_parameters({scalar_parameter("intensity", 1.0f, "multiplies the colour"),
                                      color_parameter("lightcolor", glm::vec3(1.0f), "colour"),
                                      point_parameter("from", {0, 0, 0}, "place of the light")}),
          .ambient = false,
          .illuminate = illuminate,
          .transmission = transmission_from_point};
}

}  // namespace tessera
