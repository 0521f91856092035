#include "shade/shaders_common.h"

namespace tessera {
namespace {

void surface(const ShaderContext& context, SurfaceColors& out) {
  const ShadingPoints& points = context.points();
  const std::string& map = context.string("texturename");
  if (map.empty()) return shade_plastic(context, points.Cs, out);
  Vec3Array base = context.texture(map);
  for (int i = 0; i < points.count; ++i) base.set(i, base[i] * points.Cs[i]);
  shade_plastic(context, base, out);
}

}  // namespace

/// RenderMan Interface 3.2, appendix A.1.6.
ShaderDefinition shader_paintedplastic() {
  std::vector<ParameterDeclaration> parameters = plastic_parameters();
  parameters.push_back(string_parameter("texturename", "", "colour map, looked up at st"));
  return {.name = "paintedplastic",
          .help = "plastic whose colour is multiplied by a texture",
          .parameters = std::move(parameters),
          .surface = surface};
}

}  // namespace tessera
