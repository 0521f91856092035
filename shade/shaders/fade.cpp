#include <algorithm>
#include <cmath>

#include "shade/shader.h"

namespace tessera {
namespace {

void surface(const ShaderContext& context, SurfaceColors& out) {
  const ShadingPoints& points = context.points();
  const ScalarInput facing = context.scalar("facing"), edge = context.scalar("edge");
  const ScalarInput power = context.scalar("power");
  for (int i = 0; i < points.count; ++i) {
    const float cosine = std::min(1.0f, std::abs(glm::dot(points.N[i], points.I[i])));
    const float towards_edge = std::pow(1.0f - cosine, power[i]);
    const glm::vec3 opacity = points.Os[i] * glm::mix(facing[i], edge[i], towards_edge);
    out.Oi.set(i, opacity);
    out.Ci.set(i, opacity * points.Cs[i]);
  }
}

}  // namespace

ShaderDefinition shader_fade() {
  return {.name = "fade",
          .help = "unlit, its opacity changing from where it faces the eye to its outline",
          .parameters = {scalar_parameter("facing", 0.0f, "opacity facing the eye"),
                         scalar_parameter("edge", 1.0f, "opacity at the outline"),
                         scalar_parameter("power", 1.0f, "of 1 - |cos|; larger hugs the outline")},
          .sets_opacity = true,
          .surface = surface};
}

}  // namespace tessera
