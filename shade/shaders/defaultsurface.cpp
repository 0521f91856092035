#include "shade/shader.h"

namespace tessera {
namespace {

void surface(const ShaderContext& context, SurfaceColors& out) {
  const ShadingPoints& points = context.points();
  const ScalarInput Ka = context.scalar("Ka"), Kd = context.scalar("Kd");
  for (int i = 0; i < points.count; ++i) {
    const float cosine = glm::dot(points.N[i], points.I[i]);
    const float lit = Ka[i] + Kd[i] * cosine * cosine;
    out.Oi.set(i, points.Os[i]);
    out.Ci.set(i, points.Os[i] * points.Cs[i] * lit);
  }
}

}  // namespace

/// What a surface without a shader (or with an unknown one) gets: a light at the eye, so that any
/// scene shows its shapes without lights of its own.
ShaderDefinition shader_defaultsurface() {
  return {.name = "defaultsurface",
          .aliases = {"default"},
          .help = "lit from the eye: Ka + Kd * cos^2 of the angle to the view",
          .parameters = {scalar_parameter("Ka", 0.2f, "share at any angle"),
                         scalar_parameter("Kd", 0.8f, "share facing the eye")},
          .surface = surface};
}

}  // namespace tessera
