#include <algorithm>
#include <cmath>

#include "shade/noise.h"
#include "shade/shaders_common.h"

namespace tessera {
namespace {

constexpr float largest_cost = 1e6f;
constexpr int octaves = 8;

/// 0 for NaN.
int evaluations_of(float cost) { return cost > 0.0f ? int(std::min(cost, largest_cost)) : 0; }

/// The mean of `evaluations` fields of noise, of octaves in turn and each from another place, as a
/// deviation around 0 of the same size for any number of them. Every field is evaluated, also where
/// the footprint leaves none of it.
float pattern_of(const glm::vec3& p, float footprint, int evaluations) {
  float sum = 0.0f;
  for (int k = 0; k < evaluations; ++k) {
    const float frequency = float(1 << (k % octaves));
    // Within 64 lattice cells: far from the origin a float would not resolve p.
    const glm::vec3 elsewhere =
        64.0f * glm::fract(float(k) * glm::vec3(0.618034f, 0.754878f, 0.569840f));
    sum += octave_share(footprint, frequency) * gradient_noise(frequency * p + elsewhere);
  }
  return sum / std::sqrt(float(std::max(1, evaluations)));
}

void surface(const ShaderContext& context, SurfaceColors& out) {
  const ShadingPoints& points = context.points();
  const ScalarInput cost = context.scalar("cost"), frequency = context.scalar("frequency");
  const PatternPoints pattern = context.pattern_points();
  Vec3Array base(points.count);
  for (int i = 0; i < points.count; ++i) {
    // Not average_over_cell(): what a point costs must not depend on the shape of its cell.
    const float deviation =
        pattern_of(frequency[i] * pattern.P[i],
                   std::abs(frequency[i]) * pattern.footprint[size_t(i)], evaluations_of(cost[i]));
    base.set(i, points.Cs[i] * std::clamp(1.0f + deviation, 0.0f, 2.0f));
  }
  shade_plastic(context, base, out);
}

}  // namespace

ShaderDefinition shader_expensive() {
  std::vector<ParameterDeclaration> parameters = plastic_parameters();
  parameters.push_back(
      scalar_parameter("cost", 100.0f, "noise evaluations a point, within [0, 1e6]"));
  parameters.push_back(scalar_parameter("frequency", 1.0f, "lumps per unit of shader space"));
  return {.name = "expensive",
          .help = "plastic in a colour that takes as long as asked for, to time shading with",
          .parameters = std::move(parameters),
          .primvars = {"Pref"},
          .surface = surface};
}

}  // namespace tessera
