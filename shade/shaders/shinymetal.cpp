#include "shade/shader.h"

namespace tessera {
namespace {

void surface(const ShaderContext& context, SurfaceColors& out) {
  const ShadingPoints& points = context.points();
  const ScalarInput Ka = context.scalar("Ka"), Ks = context.scalar("Ks");
  const ScalarInput Kr = context.scalar("Kr"), roughness = context.scalar("roughness");
  const Vec3Array N = context.facing_normals();
  const Illumination light = context.gather(N, roughness);
  const std::string& map = context.string("texturename");
  // Without a map the surroundings are black, as in the Interface.
  const Vec3Array seen = map.empty()
                             ? Vec3Array(points.count)
                             : context.environment(map, context.mirror_directions(N), roughness);
  for (int i = 0; i < points.count; ++i) {
    const glm::vec3 sum = Ka[i] * light.ambient[i] + Ks[i] * light.specular[i] + Kr[i] * seen[i];
    out.Oi.set(i, points.Os[i]);
    out.Ci.set(i, points.Os[i] * points.Cs[i] * sum);
  }
}

}  // namespace

/// RenderMan Interface 3.2, appendix A.1.4, except that the map is blurred by the roughness, as the
/// highlights are.
ShaderDefinition shader_shinymetal() {
  return {.name = "shinymetal",
          .help = "metal that mirrors an environment map",
          .parameters = {scalar_parameter("Ka", 1.0f, "ambient share"),
                         scalar_parameter("Ks", 1.0f, "specular share"),
                         scalar_parameter("Kr", 1.0f, "mirrored share"),
                         scalar_parameter("roughness", 0.1f, "width of highlights and blur"),
                         string_parameter("texturename", "",
                                          "latitude-longitude environment map, z up")},
          .surface = surface};
}

}  // namespace tessera
