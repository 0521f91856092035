#include "shade/shader.h"

namespace tessera {
namespace {

void surface(const ShaderContext& context, SurfaceColors& out) {
  const ShadingPoints& points = context.points();
  const ScalarInput Ka = context.scalar("Ka"), Kd = context.scalar("Kd");
  const auto lit = [&](const Illumination& light, int i) {
    return points.Os[i] * points.Cs[i] * (Ka[i] * light.ambient[i] + Kd[i] * light.diffuse[i]);
  };
  for (int i = 0; i < points.count; ++i) out.Oi.set(i, points.Os[i]);
  context.shade_lights(context.facing_normals(), nullptr, out, lit);
}

}  // namespace

/// RenderMan Interface 3.2, appendix A.1.2.
ShaderDefinition shader_matte() {
  return {.name = "matte",
          .help = "purely diffuse",
          .parameters = {scalar_parameter("Ka", 1.0f, "ambient share"),
                         scalar_parameter("Kd", 1.0f, "diffuse share")},
          .surface = surface};
}

}  // namespace tessera
