#include "shade/noise.h"
#include "shade/shader.h"

namespace tessera {
namespace {

/// The share of white in the shading cell of point i, of a board of unit squares over frequency *
/// st.
float white_share(const ShadingPoints& points, int i, float frequency) {
  const StFootprint& d = points.st_footprint;
  const auto change = [&](const float* values) { return values ? frequency * values[i] : 0.0f; };
  return checker_over_cell(frequency * glm::vec2(points.s[i], points.t[i]),
                           {change(d.dsdx), change(d.dtdx)}, {change(d.dsdy), change(d.dtdy)});
}

void surface(const ShaderContext& context, SurfaceColors& out) {
  const ShadingPoints& points = context.points();
  const ScalarInput Ka = context.scalar("Ka"), Kd = context.scalar("Kd");
  const ScalarInput frequency = context.scalar("frequency");
  const Vec3Input black = context.vec3("blackcolor");
  const Illumination light = context.gather(context.facing_normals());
  for (int i = 0; i < points.count; ++i) {
    const float white = white_share(points, i, frequency[i]);
    const glm::vec3 base = glm::mix(black[i], points.Cs[i], white);
    out.Oi.set(i, points.Os[i]);
    out.Ci.set(i, points.Os[i] * base * (Ka[i] * light.ambient[i] + Kd[i] * light.diffuse[i]));
  }
}

}  // namespace

ShaderDefinition shader_checker() {
  return {.name = "checker",
          .help = "a diffuse checkerboard over st, filtered over the cell",
          .parameters = {scalar_parameter("Ka", 1.0f, "ambient share"),
                         scalar_parameter("Kd", 1.0f, "diffuse share"),
                         scalar_parameter("frequency", 10.0f, "squares per unit of s and t"),
                         color_parameter("blackcolor", glm::vec3(0.0f),
                                         "of every other square; the rest have the surface's")},
          .surface = surface};
}

}  // namespace tessera
