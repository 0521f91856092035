#include <cmath>

#include "shade/mathematics.h"
#include "shade/shader.h"

namespace tessera {
namespace {

void displace(const ShaderContext& context, std::span<float> distance) {
  const ScalarInput amplitude = context.scalar("amplitude");
  const ScalarInput frequency = context.scalar("frequency"), phase = context.scalar("phase");
  const Vec3Input direction = context.vec3("direction");
  const PatternPoints pattern = context.pattern_points();
  for (int i = 0; i < context.count(); ++i) {
    const glm::vec3 along = unit_or_zero(context.shader_vector(direction[i]));
    const float waves = frequency[i] * glm::dot(along, pattern.P[i]) + phase[i];
    distance[size_t(i)] = amplitude[i] * std::sin(2.0f * pi * waves);
  }
}

}  // namespace

ShaderDefinition shader_ripple() {
  return {.name = "ripple",
          .aliases = {"sine"},
          .help = "sine waves along a direction of shader space",
          .kind = ShaderKind::displacement,
          .parameters = {scalar_parameter("amplitude", 0.1f, "height, world units"),
                         scalar_parameter("frequency", 1.0f, "waves per unit of shader space"),
                         scalar_parameter("phase", 0.0f, "in waves"),
                         vector_parameter("direction", {1, 0, 0}, "in which the wave runs")},
          .primvars = {"Pref"},
          .displace = displace};
}

}  // namespace tessera
