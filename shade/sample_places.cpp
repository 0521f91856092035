#include "shade/sample_places.h"

#include "base/hash.h"
#include "hide/sobol.h"

namespace tessera {
namespace {

/// Nested uniform scramble of a fraction with 24 digits.
float owen_scrambled(float x, uint32_t seed) {
  const auto digits = uint32_t(x * 16777216.0f);
  const uint32_t reversed = owen_scramble_reversed(reverse_bits(digits << 8), seed);
  return float(reverse_bits(reversed) >> 8) / 16777216.0f;
}

}  // namespace

SamplePlaces::SamplePlaces(const SampleBlock& samples, RayEffect effect, size_t number)
    : samples_(samples),
      x_(effect == RayEffect::shadow ? samples.light_x : samples.bounce_x),
      y_(effect == RayEffect::shadow ? samples.light_y : samples.bounce_y),
      number_(uint32_t(number)) {
  if (x_.size() < samples.size() || y_.size() < samples.size())
    throw Error(
        fmt::format("the samples carry no places for rays of the {}; expected a pattern "
                    "with SampleExtras",
                    effect == RayEffect::shadow ? "lights" : "bounces"));
}

glm::vec2 SamplePlaces::of_sample(uint32_t sample) const {
  if (number_ == 0) return {x_[sample], y_[sample]};
  const auto per_pixel = uint32_t(samples_.samples_per_pixel);
  const auto width = uint32_t(samples_.rect.width());
  const uint32_t pixel = sample / per_pixel, first = pixel * per_pixel;
  const uint32_t x = uint32_t(samples_.rect.x0) + pixel % width;
  const uint32_t y = uint32_t(samples_.rect.y0) + pixel / width;
  const uint32_t seed = hash_combine(hash_combine(mix32(number_), x), y);
  const uint32_t other = first + permuted_index(sample - first, per_pixel, seed);
  return {owen_scrambled(x_[other], mix32(seed + 1)), owen_scrambled(y_[other], mix32(seed + 2))};
}

}  // namespace tessera
