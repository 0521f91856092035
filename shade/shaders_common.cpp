#include "shade/shaders_common.h"

namespace tessera {

std::vector<ParameterDeclaration> plastic_parameters(float Kd, float Ks) {
  return {scalar_parameter("Ka", 1.0f, "ambient share"),
          scalar_parameter("Kd", Kd, "diffuse share"), scalar_parameter("Ks", Ks, "specular share"),
          scalar_parameter("roughness", 0.1f, "width of highlights"),
          color_parameter("specularcolor", glm::vec3(1.0f), "colour of highlights")};
}

void shade_plastic(const ShaderContext& context, const Vec3Input& base, SurfaceColors& out) {
  const ShadingPoints& points = context.points();
  const ScalarInput Ka = context.scalar("Ka"), Kd = context.scalar("Kd");
  const ScalarInput Ks = context.scalar("Ks");
  const Vec3Input specular_color = context.vec3("specularcolor");
  const ScalarInput roughness = context.scalar("roughness");
  const auto lit = [&](const Illumination& light, int i) {
    const glm::vec3 body = base[i] * (Ka[i] * light.ambient[i] + Kd[i] * light.diffuse[i]);
    const glm::vec3 highlight = specular_color[i] * (Ks[i] * light.specular[i]);
    return points.Os[i] * (body + highlight);
  };
  for (int i = 0; i < points.count; ++i) out.Oi.set(i, points.Os[i]);
  context.shade_lights(context.facing_normals(), &roughness, out, lit);
}

}  // namespace tessera
