#include "shade/noise.h"
#include "shade/shader.h"

namespace tessera {
namespace {

void displace(const ShaderContext& context, std::span<float> distance) {
  const ScalarInput amplitude = context.scalar("amplitude"),
                    frequency = context.scalar("frequency"), octaves = context.scalar("octaves");
  const PatternPoints pattern = context.pattern_points();
  for (int i = 0; i < context.count(); ++i) {
    distance[size_t(i)] =
        amplitude[i] * fractal_noise(frequency[i] * pattern.P[i], 0.0f, octave_count(octaves[i]));
  }
}

}  // namespace

ShaderDefinition shader_bumpy() {
  return {.name = "bumpy",
          .help = "soft lumps of fractal noise in shader space",
          .kind = ShaderKind::displacement,
          .parameters = {scalar_parameter("amplitude", 0.1f, "height, world units"),
                         scalar_parameter("frequency", 1.0f, "lumps per unit of shader space"),
                         scalar_parameter("octaves", 1.0f, "of noise, each twice as fine")},
          .primvars = {"Pref"},
          .displace = displace};
}

}  // namespace tessera
