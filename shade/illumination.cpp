#include "shade/illumination.h"

#include <algorithm>

#include "shade/normal_spread.h"

namespace tessera {
namespace {

/// Keeps 1 / roughness finite.
constexpr float least_roughness = 1e-4f;

void add_diffuse(const LightSamples& light, const ShadingPoints& points, const Vec3Input& N,
                 Vec3Array& sum) {
  for (int i = 0; i < points.count; ++i) {
    const glm::vec3 n = N[i];
    sum.add(i, light.Cl[i] * mean_clamped_cosine(n, light.L[i], normal_spread(points, i, n)));
  }
}

void add_specular(const LightSamples& light, const ShadingPoints& points, const Vec3Input& N,
                  const ScalarInput& roughness, Vec3Array& sum) {
  for (int i = 0; i < points.count; ++i) {
    const glm::vec3 n = N[i], l = light.L[i];
    if (glm::dot(n, l) <= 0.0f) continue;
    const float exponent = 1.0f / std::max(roughness[i], least_roughness);
    const glm::vec3 h = l - points.I[i];  // zero where the light is straight behind the point
    sum.add(i,
            light.Cl[i] * mean_specular_lobe(n, h, exponent, half_vector_spread(points, i, n, h)));
  }
}

/// Multiplies what arrives by the share that nothing blocks.
void cast_shadows(const BoundLight& light, const ShadingPoints& points, LightSamples& samples,
                  std::vector<float>& share, ShadeCounters& counters) {
  share.resize(size_t(points.count));
  light.definition->transmission(light, points, share);
  counters.shadow_lookups += uint64_t(points.count);
  for (int i = 0; i < points.count; ++i) samples.Cl.set(i, share[size_t(i)] * samples.Cl[i]);
}

}  // namespace

void gather_light(std::span<const BoundLight* const> lights, const ShadingPoints& points,
                  const Vec3Input& N, const ScalarInput* roughness, Shadows shadows,
                  Illumination& out, ShadeCounters& counters) {
  out.ambient.reset(points.count);
  out.diffuse.reset(points.count);
  if (roughness) out.specular.reset(points.count);
  LightSamples samples;
  std::vector<float> share;
  for (const BoundLight* light : lights) {
    samples.L.reset(points.count);
    samples.Cl.reset(points.count);
    light->definition->illuminate(light->parameters, points, samples);
    counters.light_evaluations += uint64_t(points.count);
    if (light->shadow && shadows == Shadows::cast) {
      cast_shadows(*light, points, samples, share, counters);
    }
    if (light->definition->ambient) {
      for (int i = 0; i < points.count; ++i) out.ambient.add(i, samples.Cl[i]);
      continue;
    }
    if (light->definition->hemisphere) {
      for (int i = 0; i < points.count; ++i) out.diffuse.add(i, samples.Cl[i]);
      continue;
    }
    add_diffuse(samples, points, N, out.diffuse);
    if (roughness) add_specular(samples, points, N, *roughness, out.specular);
  }
}

}  // namespace tessera
