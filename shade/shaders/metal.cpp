#include "shade/shader.h"

namespace tessera {
namespace {

void surface(const ShaderContext& context, SurfaceColors& out) {
  const ShadingPoints& points = context.points();
  const ScalarInput Ka = context.scalar("Ka"), Ks = context.scalar("Ks");
  const Illumination light = context.gather(context.facing_normals(), context.scalar("roughness"));
  for (int i = 0; i < points.count; ++i) {
    out.Oi.set(i, points.Os[i]);
    out.Ci.set(
        i, points.Os[i] * points.Cs[i] * (Ka[i] * light.ambient[i] + Ks[i] * light.specular[i]));
  }
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
