#include "shade/light.h"

namespace tessera {
namespace {

void illuminate(const BoundParameters& parameters, const ShadingPoints& points, LightSamples& out) {
  const glm::vec3 color = parameters.scalar("intensity") * parameters.vec3("lightcolor");
  for (int i = 0; i < points.count; ++i) out.Cl.set(i, color);
}

}  // namespace

/// RenderMan Interface 3.2, appendix A.2.1.
LightDefinition light_ambientlight() {
  return {.name = "ambientlight",
          .help = "the same light from everywhere",
          .parameters = {scalar_parameter("intensity", 1.0f, "multiplies the colour"),
                         color_parameter("lightcolor", glm::vec3(1.0f), "colour")},
          .ambient = true,
          .illuminate = illuminate};
}

}  // namespace tessera
