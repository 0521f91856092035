#include "shade/shader.h"

namespace tessera {
namespace {

void surface(const ShaderContext& context, SurfaceColors& out) {
  const ShadingPoints& points = context.points();
  for (int i = 0; i < points.count; ++i) {
    out.Oi.set(i, points.Os[i]);
    out.Ci.set(i, points.Os[i] * points.Cs[i]);
  }
}

}  // namespace

/// RenderMan Interface 3.2, appendix A.1.1.
ShaderDefinition shader_constant() {
  return {.name = "constant", .help = "its own colour, whatever the light", .surface = surface};
}

}  // namespace tessera
