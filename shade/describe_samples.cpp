#include <cmath>

#include "shade/aov.h"
#include "shade/fragment_layers.h"
#include "shade/view.h"

namespace tessera {
namespace {

void add(std::array<std::vector<float>, 3>& values, size_t at, const glm::vec3& v) {
  for (size_t c = 0; c < 3; ++c) values[c][at] += v[int(c)];
}

bool lit(const EffectValues& effect, size_t fragment) {
  const auto& [r, g, b] = effect.unblocked;
  return r[fragment] > 0.0f || g[fragment] > 0.0f || b[fragment] > 0.0f;
}

/// Where in the effect a sample lies is that of the nearest fragment it lights: coordinates of
/// several cannot be mixed.
void describe_effect(const ShadeInput& input, const ShadedFragments& shaded,
                     const EffectValues& of_fragments, EffectValues& of_samples) {
  const size_t samples = input.samples->size();
  if (of_fragments.empty()) {
    of_samples.resize(0);
    return;
  }
  of_samples.resize(samples);
  const bool drawn = !of_fragments.drawn[0].empty();
  if (drawn) of_samples.add_drawn();
  for (size_t s = 0; s < samples; ++s) {
    size_t nearest = no_fragment;
    for_layers(input, shaded, fragments_of(*input.fragments, s),
               [&](size_t f, const glm::vec3& through) {
                 add(of_samples.received, s, through * color_at(of_fragments.received, f));
                 add(of_samples.unblocked, s, through * color_at(of_fragments.unblocked, f));
                 if (drawn) add(of_samples.drawn, s, through * color_at(of_fragments.drawn, f));
                 if (nearest == no_fragment && lit(of_fragments, f)) nearest = f;
               });
    if (nearest == no_fragment) continue;
    for (size_t axis = 0; axis < 2; ++axis) {
      of_samples.y[axis][s] = of_fragments.y[axis][nearest];
      of_samples.extent[axis][s] = of_fragments.extent[axis][nearest];
    }
    of_samples.slope[s] = of_fragments.slope[nearest];
  }
}

void set_pair(std::array<std::vector<float>, 2>& values, size_t at, const glm::vec2& v) {
  if (values[0].empty() || !std::isfinite(v.x) || !std::isfinite(v.y)) return;
  values[0][at] = v.x, values[1][at] = v.y;
}

void describe_surface(const ShadeInput& input, const Camera& camera, size_t fragment, size_t sample,
                      SampleSurfaces& out) {
  const FragmentGeometry seen(input, fragment);
  const float z = input.fragments->z[fragment];
  if (!out.coc[0].empty()) set_pair(out.coc, sample, camera.coc_raster(z));
  if (!out.velocity[0].empty()) set_pair(out.velocity, sample, raster_motion(seen, camera));
  add(out.N, sample, turned_against(unit_normal(seen), along_view(camera, seen.P_camera(0.0f))));
  out.surface[sample] = uint32_t(seen.grid->surface->id) + 1;
}

void describe_surfaces(const ShadeInput& input, const ShadedFragments& shaded, const Camera& camera,
                       bool lens, bool motion, SampleSurfaces& out) {
  const size_t samples = input.samples->size();
  for (auto& axis : out.coc) axis.assign(lens ? samples : 0, 0.0f);
  for (auto& axis : out.velocity) axis.assign(motion ? samples : 0, 0.0f);
  for (auto& axis : out.N) axis.assign(samples, 0.0f);
  out.surface.assign(samples, 0);
  for (size_t s = 0; s < samples; ++s) {
    const size_t f = nearest_surface(input, shaded, fragments_of(*input.fragments, s));
    if (f != no_fragment) describe_surface(input, camera, f, s, out);
  }
}

/// Without the padding.
void copy(const AlignedVector<float>& from, size_t samples, std::vector<float>& to) {
  to.assign(from.begin(), from.begin() + long(from.empty() ? 0 : samples));
}

}  // namespace

void describe_samples(const ShadeInput& input, const ShadedFragments& shaded, const Camera& camera,
                      bool lens, bool motion, DistributionSamples& out) {
  for (size_t e = 0; e < ray_effect_count; ++e)
    describe_effect(input, shaded, shaded.effects[e], out.effects[e]);
  describe_surfaces(input, shaded, camera, lens, motion, out.surfaces);
  const SampleBlock& block = *input.samples;
  copy(block.u, block.size(), out.u);
  copy(block.v, block.size(), out.v);
  copy(block.t, block.size(), out.t);
}

}  // namespace tessera
