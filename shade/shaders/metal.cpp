#include "shade/shader.h"

namespace tessera {
namespace {

void surface(const ShaderContext& context, SurfaceColors& out) {
  const ShadingPoints& points = context.points();
  const ScalarInput Ka = context.scalar("Ka"), Ks = context.scalar("Ks");
  const ScalarInput roughness = context.scalar("roughness");
  const auto lit = [&](const Illumination& light, int i) {
    return points.Os[i] * points.Cs[i] * (Ka[i] * light.ambient[i] + Ks[i] * light.specular[i]);
  };
  for (int i = 0; i < points.count; ++i) out.Oi.set(i, points.Os[i]);
  context.shade_lights(context.facing_normals(), &roughness, out, lit);
}

}  // namespace

/// RenderMan Interface 3.2, appendix A.1.3.
ShaderDefinition shader_metal() {
  return {.name = "metal",
          .help = "highlights in the colour of the surface",
          .parameters = {scalar_parameter("Ka", 1.0f, "ambient share"),
                         scalar_parameter("Ks", 1.0f, "specular share"),
                         scalar_parameter("roughness", 0.1f, "width of highlights")},
          .surface = surface};
}

}  // namespace tessera
