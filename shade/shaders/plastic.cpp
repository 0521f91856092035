#include "shade/shaders_common.h"

namespace tessera {
namespace {

void surface(const ShaderContext& context, SurfaceColors& out) {
  shade_plastic(context, context.points().Cs, out);
}

}  // namespace

/// RenderMan Interface 3.2, appendix A.1.5.
ShaderDefinition shader_plastic() {
  return {.name = "plastic",
          .help = "diffuse, with highlights in a colour of their own",
          .parameters = plastic_parameters(),
          .surface = surface};
}

}  // namespace tessera
