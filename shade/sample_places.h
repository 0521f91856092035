#pragma once
/// Where on a light, or which way, the ray of a sample goes.

#include "shade/shade.h"

namespace tessera {

/// The coordinates xi of one light in a bucket. The first light of an effect takes the sample's own
/// (SampleBlock::light_x, ...). Each further one takes those of another sample of the pixel, in an
/// order of its own and with digits scrambled anew (A. Owen's nested uniform scrambling), so that
/// lights share no noise and each has a net in every pixel still.
class SamplePlaces {
 public:
  /// `number` counts the lights of `effect` from 0. Throws Error if the samples carry no
  /// coordinates for the effect.
  SamplePlaces(const SampleBlock& samples, RayEffect effect, size_t number);
  /// In [0, 1)^2. A function of the sample's place in the frame, whatever the bucket.
  glm::vec2 of_sample(uint32_t sample) const;

 private:
  const SampleBlock& samples_;
  const AlignedVector<float>&x_, &y_;
  uint32_t number_;
};

}  // namespace tessera
