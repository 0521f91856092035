#include <cmath>

#include "shade/noise.h"
#include "shade/shader.h"

namespace tessera {
namespace {

/// Sizes of the axis-aligned box in st that holds the parallelogram of the shading cell.
glm::vec2 st_width(const StFootprint& d, int i) {
  if (!d.dsdx) return glm::vec2(0.0f);
  return {std::abs(d.dsdx[i]) + std::abs(d.dsdy[i]), std::abs(d.dtdx[i]) + std::abs(d.dtdy[i])};
}

void surface(const ShaderContext& context, SurfaceColors& out) {
  const ShadingPoints& points = context.points();
  const ScalarInput Ka = context.scalar("Ka"), Kd = context.scalar("Kd");
  const ScalarInput frequency = context.scalar("frequency");
  const Vec3Input black = context.vec3("blackcolor");
  Vec3Array base(points.count);
  for (int i = 0; i < points.count; ++i) {
    const glm::vec2 st(points.s[i], points.t[i]);
    const float white = filtered_checker(frequency[i] * st,
                                         std::abs(frequency[i]) * st_width(points.st_footprint, i));
    base.set(i, glm::mix(black[i], points.Cs[i], white));
    out.Oi.set(i, points.Os[i]);
  }
  const auto lit = [&](const Illumination& light, int i) {
    return points.Os[i] * base[i] * (Ka[i] * light.ambient[i] + Kd[i] * light.diffuse[i]);
  };
  context.shade_lights(context.facing_normals(), nullptr, out, lit);
}

}  // namespace

ShaderDefinition shader_checker() {
  return {.name = "checker",
          .help = "a diffuse checkerboard over st, box-filtered exactly",
          .parameters = {scalar_parameter("Ka", 1.0f, "ambient share"),
                         scalar_parameter("Kd", 1.0f, "diffuse share"),
                         scalar_parameter("frequency", 10.0f, "squares per unit of s and t"),
                         color_parameter("blackcolor", glm::vec3(0.0f),
                                         "of every other square; the rest have the surface's")},
          .surface = surface};
}

}  // namespace tessera
