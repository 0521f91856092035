#include "shade/noise.h"
#include "shade/shader.h"

namespace tessera {
namespace {

constexpr int octaves = 6;

void displace(const ShaderContext& context, std::span<float> distance) {
  const ScalarInput Km = context.scalar("Km"), frequency = context.scalar("frequency");
  const PatternPoints pattern = context.pattern_points();
  for (int i = 0; i < context.count(); ++i) {
    // Halved, turbulence stays below 1, so that Km bounds the depth. The cube leaves most of the
    // surface alone and deepens the few high places of the noise.
    const float depth = 0.5f * turbulence(frequency[i] * pattern.P[i], 0.0f, octaves);
    distance[size_t(i)] = -Km[i] * depth * depth * depth;
  }
}

}  // namespace

ShaderDefinition shader_dented() {
  return {.name = "dented",
          .help = "dents of cubed turbulence in shader space, inwards",
          .kind = ShaderKind::displacement,
          .parameters = {scalar_parameter("Km", 1.0f, "deepest dent, world units"),
                         scalar_parameter("frequency", 1.0f, "dents per unit of shader space")},
          .primvars = {"Pref"},
          .displace = displace};
}

}  // namespace tessera
