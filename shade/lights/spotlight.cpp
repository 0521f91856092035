#include <cmath>

#include "shade/light_shadows.h"
#include "shade/mathematics.h"

namespace tessera {
namespace {

void illuminate(const BoundParameters& parameters, const ShadingPoints& points, LightSamples& out) {
  const glm::vec3 from = parameters.vec3("from");
  const glm::vec3 axis = unit_or_zero(parameters.vec3("to") - from);
  if (axis == glm::vec3(0.0f)) return;  // from and to coincide: no axis, no light
  const glm::vec3 color = parameters.scalar("intensity") * parameters.vec3("lightcolor");
  const float cone_angle = parameters.scalar("coneangle");
  const float cos_outer = std::cos(cone_angle);
  const float cos_inner = std::cos(cone_angle - parameters.scalar("conedeltaangle"));
  const float beam_distribution = parameters.scalar("beamdistribution");
  for (int i = 0; i < points.count; ++i) {
    const glm::vec3 towards = from - points.P[i];
    const float distance = glm::length(towards);
    if (!(distance > 0.0f)) continue;
    const float cosine = -glm::dot(towards, axis) / distance;
    if (cosine < cos_outer) continue;
    // A cone wider than 90 degrees reaches behind the light, where the power is undefined.
    const float beam = std::pow(std::max(cosine, 0.0f), beam_distribution);
    out.L.set(i, towards / distance);
    out.Cl.set(i, color / distance / distance * beam * smoothstep(cos_outer, cos_inner, cosine));
  }
}

}  // namespace

/// RenderMan Interface 3.2, appendix A.2.4.
LightDefinition light_spotlight() {
  return {.name = "spotlight",
          .help = "a cone of light from a point, falling off with distance squared",
          .parameters = with_shadow_parameters(
              {scalar_parameter("intensity", 1.0f, "multiplies the colour"),
               color_parameter("lightcolor", glm::vec3(1.0f), "colour"),
               point_parameter("from", {0, 0, 0}, "place of the light"),
               point_parameter("to", {0, 0, 1}, "a point on the axis of the cone"),
               scalar_parameter("coneangle", radians(30.0f), "from axis to edge, radians"),
               scalar_parameter("conedeltaangle", radians(5.0f), "width of the soft edge, radians"),
               scalar_parameter("beamdistribution", 2.0f, "power of the cosine off the axis")}),
          .ambient = false,
          .illuminate = illuminate,
          .transmission = transmission_from_point};
}

}  // namespace tessera
