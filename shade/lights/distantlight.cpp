#include "shade/light_shadows.h"
#include "shade/mathematics.h"

namespace tessera {
namespace {

void illuminate(const BoundParameters& parameters, const ShadingPoints& points, LightSamples& out) {
  const glm::vec3 L = unit_or_zero(parameters.vec3("from") - parameters.vec3("to"));
  if (L == glm::vec3(0.0f)) return;  // from and to coincide: no direction, no light
  const glm::vec3 color = parameters.scalar("intensity") * parameters.vec3("lightcolor");
  for (int i = 0; i < points.count; ++i) {
    out.L.set(i, L);
    out.Cl.set(i, color);
  }
}

}  // namespace

/// RenderMan Interface 3.2, appendix A.2.2.
LightDefinition light_distantlight() {
  return {.name = "distantlight",
          .help = "parallel light, as of the sun",
          .parameters = with_shadow_parameters(
              {scalar_parameter("intensity", 1.0f, "multiplies the colour"),
               color_parameter("lightcolor", glm::vec3(1.0f), "colour"),
               point_parameter("from", {0, 0, 0}, "light travels from here ..."),
               point_parameter("to", {0, 0, 1}, "... towards here")}),
          .ambient = false,
          .illuminate = illuminate,
          .transmission = transmission_from_distance};
}

}  // namespace tessera
