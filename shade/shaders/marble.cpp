#include <cmath>

#include "shade/mathematics.h"
#include "shade/noise.h"
#include "shade/shaders_common.h"

namespace tessera {
namespace {

constexpr int octaves = 7;

/// Share of vein, in [0, 1]: a cosine along x whose phase is shaken by turbulence.
float vein(const glm::vec3& p, float footprint, float turbulence_weight) {
  const float phase = p.x + turbulence_weight * turbulence(p, footprint, octaves);
  // The wave has one period a unit; where the cell cannot show it, its mean remains.
  const float wave = octave_share(footprint, 1.0f) * std::cos(2.0f * pi * phase);
  const float ridge = 0.5f + 0.5f * wave;
  return ridge * ridge * ridge;
}

void surface(const ShaderContext& context, SurfaceColors& out) {
  const ShadingPoints& points = context.points();
  const ScalarInput frequency = context.scalar("frequency"), veining = context.scalar("veining");
  const Vec3Input vein_color = context.vec3("veincolor");
  const PatternPoints pattern = context.pattern_points();
  Vec3Array base(points.count);
  for (int i = 0; i < points.count; ++i) {
    const auto vein_at = [&](const glm::vec3& P, float footprint) {
      return vein(frequency[i] * P, std::abs(frequency[i]) * footprint, veining[i]);
    };
    const float share = pattern.average_over_cell(i, vein_at);
    base.set(i, glm::mix(points.Cs[i], vein_color[i], share));
  }
  shade_plastic(context, base, out);
}

}  // namespace

ShaderDefinition shader_marble() {
  std::vector<ParameterDeclaration> parameters = plastic_parameters(0.8f, 0.2f);
  parameters.push_back(scalar_parameter("frequency", 1.0f, "veins per unit of shader space"));
  parameters.push_back(scalar_parameter("veining", 2.0f, "how far turbulence bends the veins"));
  parameters.push_back(color_parameter("veincolor", {0.15f, 0.13f, 0.18f}, "of the veins"));
  return {.name = "marble",
          .help = "polished stone with veins, solid in shader space",
          .parameters = std::move(parameters),
          .primvars = {"Pref"},
          .surface = surface};
}

}  // namespace tessera
