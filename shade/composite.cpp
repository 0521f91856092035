#include <algorithm>
#include <limits>

#include "shade/aov.h"
#include "shade/fragment_layers.h"

namespace tessera {
namespace {

/// The part of the colour that bounces brought is kept apart where there are any.
CompositedSample composite_sample(const ShadeInput& input, const ShadedFragments& shaded,
                                  FragmentRange range) {
  CompositedSample sum;
  const EffectValues& bounce = shaded.effects[size_t(RayEffect::bounce)];
  for_layers(input, shaded, range, [&](size_t f, const glm::vec3& through) {
    sum.color += through * color_at(shaded.Ci, f);
    sum.opacity += through * color_at(shaded.Oi, f);
    if (!bounce.empty()) sum.indirect += through * color_at(bounce.received, f);
  });
  return sum;
}

constexpr size_t largest_group = 4;  // channels

/// Calls write(sample, values) for every sample and stores what it wrote.
template <class Write>
void for_samples(size_t samples, size_t channels, std::vector<float>& out, Write write) {
  out.resize(channels * samples);
  float values[largest_group];
  for (size_t s = 0; s < samples; ++s) {
    write(s, values);
    for (size_t c = 0; c < channels; ++c) out[c * samples + s] = values[c];
  }
}

/// The sample of a pixel nearest to shutter open and the lens centre that sees something, or the
/// first.
size_t opening_sample(const SampleBlock& samples, size_t first, std::span<const size_t> nearest) {
  size_t best = first;
  float least = std::numeric_limits<float>::infinity();
  for (size_t s = first; s < first + size_t(samples.samples_per_pixel); ++s) {
    if (nearest[s] == no_fragment) continue;
    const float t = samples.t.empty() ? 0.0f : samples.t[s];
    const float u = samples.u.empty() ? 0.0f : samples.u[s];
    const float v = samples.u.empty() ? 0.0f : samples.v[s];
    const float distance = t * t + u * u + v * v;
    if (distance < least) best = s, least = distance;
  }
  return best;
}

/// Gives all samples of a pixel the values of its opening_sample().
void spread_opening(const SampleBlock& samples, std::span<const size_t> nearest, size_t channels,
                    std::vector<float>& values) {
  const size_t spp = size_t(samples.samples_per_pixel), count = samples.size();
  for (size_t first = 0; first < count; first += spp) {
    const size_t from = opening_sample(samples, first, nearest);
    for (size_t c = 0; c < channels; ++c)
      std::fill_n(&values[c * count + first], spp, values[c * count + from]);
  }
}

}  // namespace

void composite(const ShadeInput& input, const ShadedFragments& shaded, const Camera& camera,
               std::span<const AovDefinition* const> groups, std::vector<std::vector<float>>& out) {
  const size_t samples = input.samples->size();
  std::vector<const AovEvaluator*> evaluators;
  for (const AovDefinition* group : groups) evaluators.push_back(&evaluator_of(*group));
  const auto any_has = [&](auto member) {
    return std::ranges::any_of(evaluators, [&](const auto* e) { return e->*member != nullptr; });
  };
  std::vector<CompositedSample> composited;
  if (any_has(&AovEvaluator::of_sample)) {
    composited.resize(samples);
    for (size_t s = 0; s < samples; ++s) {
      composited[s] = composite_sample(input, shaded, fragments_of(*input.fragments, s));
    }
  }
  std::vector<size_t> nearest;
  if (any_has(&AovEvaluator::of_surface)) {
    nearest.resize(samples);
    for (size_t s = 0; s < samples; ++s) {
      nearest[s] = nearest_surface(input, shaded, fragments_of(*input.fragments, s));
    }
  }
  out.resize(groups.size());
  for (size_t g = 0; g < groups.size(); ++g) {
    const AovEvaluator& evaluator = *evaluators[g];
    const size_t channels = evaluator.definition.channels.size();
    for_samples(samples, channels, out[g], [&](size_t s, float* values) {
      if (evaluator.of_sample) return evaluator.of_sample(composited[s], values);
      if (nearest[s] != no_fragment) {
        return evaluator.of_surface({input, shaded, camera}, nearest[s], values);
      }
      std::fill_n(values, channels, evaluator.definition.background);
    });
    if (evaluator.at_opening) spread_opening(*input.samples, nearest, channels, out[g]);
  }
}

}  // namespace tessera
