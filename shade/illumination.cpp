#include "shade/illumination.h"

#include <algorithm>

#include "shade/hemisphere.h"
#include "shade/normal_spread.h"
#include "shade/ray_shadows.h"

namespace tessera {
namespace {

/// Keeps 1 / roughness finite.
constexpr float least_roughness = 1e-4f;

/// How the normals N of each point spread within its cell: the same for every light.
std::vector<NormalSpread> normal_spreads(const ShadingPoints& points, const Vec3Input& N) {
  std::vector<NormalSpread> spreads;
  spreads.reserve(size_t(points.count));
  for (int i = 0; i < points.count; ++i) spreads.push_back(normal_spread(points, i, N[i]));
  return spreads;
}

void add_diffuse(const LightSamples& light, const Vec3Input& N,
                 std::span<const NormalSpread> spreads, Vec3Array& sum) {
  for (int i = 0; i < int(spreads.size()); ++i)
    sum.add(i, light.Cl[i] * mean_clamped_cosine(N[i], light.L[i], spreads[size_t(i)]));
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

/// Cl times `share`, one entry a point.
void scale(std::span<const float> share, Vec3Array& Cl) {
  for (int i = 0; i < Cl.count(); ++i) Cl.set(i, share[size_t(i)] * Cl[i]);
}

/// The sums over the lights that gather_light() is filling, and what they are taken at.
struct Gathering {
  const ShadingPoints& points;
  const Vec3Input& N;
  const ScalarInput* roughness;  ///< null: no specular
  Shadows shadows;
  Illumination& out;
  ShadeCounters& counters;
  std::span<const NormalSpread> spreads;  ///< of N

  /// Whether shadows of `light` are part of what is gathered.
  bool casts(const BoundLight& light) const {
    return shadows == Shadows::cast && light.casts_shadows();
  }
  void add_directed(const LightSamples& samples) const {
    add_diffuse(samples, N, spreads, out.diffuse);
    if (roughness) add_specular(samples, points, N, *roughness, out.specular);
  }
};

/// Multiplies what arrives by the share that nothing blocks.
void cast_shadows(const Gathering& gathering, const BoundLight& light, Vec3Array& Cl) {
  std::vector<float> share(size_t(gathering.points.count));
  light.definition->transmission(light, gathering.points, share);
  uint64_t& count = light.shadow ? gathering.counters.shadow_lookups : gathering.counters.rays;
  count += share.size();
  scale(share, Cl);
}

/// Multiplies what arrives from everywhere over the surface by the mean of the shares that arrive
/// from its places.
void cast_hemisphere_shadows(const Gathering& gathering, const BoundLight& light,
                             const ShadingPoints& facing, Vec3Array& Cl) {
  LightServices services = *light.services;
  services.counters = &gathering.counters;
  Vec3Array share;
  mean_share(light, facing, light.places, services, share);
  for (int i = 0; i < facing.count; ++i) Cl.set(i, share[i] * Cl[i]);
}

/// A light without extent, or one from everywhere over the surface.
void gather_whole(const Gathering& gathering, const BoundLight& light) {
  const ShadingPoints& points = gathering.points;
  ShadingPoints facing = points;
  facing.N = gathering.N;
  LightSamples samples{Vec3Array(points.count), Vec3Array(points.count)};
  const LightDefinition& definition = *light.definition;
  definition.illuminate(light.parameters, definition.hemisphere ? facing : points, samples);
  gathering.counters.light_evaluations += uint64_t(points.count);
  if (gathering.casts(light)) {
    const bool by_places = definition.distributed() && light.services;
    if (by_places) cast_hemisphere_shadows(gathering, light, facing, samples.Cl);
    if (definition.transmission) cast_shadows(gathering, light, samples.Cl);
  }
  if (!definition.ambient && !definition.hemisphere) return gathering.add_directed(samples);
  Vec3Array& sum = definition.ambient ? gathering.out.ambient : gathering.out.diffuse;
  for (int i = 0; i < points.count; ++i) sum.add(i, samples.Cl[i]);
}

/// No ray need be cast where the whole cell is turned away from the place.
void leave_out_unlit(const Vec3Input& N, std::span<const NormalSpread> spreads,
                     PlaceSamples& from) {
  for (int i = 0; i < int(spreads.size()); ++i) {
    const float cosine = mean_clamped_cosine(N[i], from.arriving.L[i], spreads[size_t(i)]);
    if (cosine <= 0.0f) from.towards.set(i, glm::vec3(0.0f));
  }
}

/// A light with extent: the mean over its places.
void gather_places(const Gathering& gathering, const BoundLight& light) {
  ShadingPoints facing = gathering.points;
  facing.N = gathering.N;
  PlaceSamples from;
  PlaceShadows shadows;
  std::vector<glm::vec2> xi(size_t(facing.count));
  const bool casts = gathering.casts(light) && light.services;
  const std::vector<glm::vec2>& places = casts ? light.places : light.open_places;
  const float weight = 1.0f / float(places.size());
  for (const glm::vec2& place : places) {
    std::ranges::fill(xi, place);
    illuminate_from(light, facing, xi, &gathering.counters, from);
    Vec3Array& Cl = from.arriving.Cl;
    for (int i = 0; i < facing.count; ++i) Cl.set(i, weight * Cl[i]);
    if (casts) {
      leave_out_unlit(gathering.N, gathering.spreads, from);
      trace_shadows(light.services->rays, facing, from.towards, light.extent.infinite, shadows);
      gathering.counters.rays += shadows.rays;
      scale(shadows.share, Cl);
    }
    gathering.add_directed(from.arriving);
  }
  gathering.counters.light_evaluations += uint64_t(facing.count) * places.size();
}

}  // namespace

void gather_light(std::span<const BoundLight* const> lights, const ShadingPoints& points,
                  const Vec3Input& N, const ScalarInput* roughness, Shadows shadows,
                  Illumination& out, ShadeCounters& counters) {
  out.ambient.reset(points.count);
  out.diffuse.reset(points.count);
  if (roughness) out.specular.reset(points.count);
  const std::vector<NormalSpread> spreads = normal_spreads(points, N);
  const Gathering gathering{points, N, roughness, shadows, out, counters, spreads};
  for (const BoundLight* light : lights) {
    if (light->definition->illuminate_from) {
      gather_places(gathering, *light);
    } else {
      gather_whole(gathering, *light);
    }
  }
}

}  // namespace tessera
