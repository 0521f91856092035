#pragma once
/// What the places of a light that samples drew would send, against what the light as a whole does.

#include "reconstruct/component.h"
#include "reconstruct/pixel_facts.h"

namespace tessera {

/// EffectValues::drawn is EffectValues::unblocked in the mean, but for cells: a cell's light is
/// summed over fixed places and for its mean normal, a sample's is that of one place and its own.
/// The ratio of shadows is one of drawn light, so it leaves that difference out; this gives it
/// back.
///
/// `sums` and `even_sums` are planes [drawn, unblocked][channel][pixel], means over all and over
/// even samples (times their share). Returns the ratio of drawn to unblocked light
/// [channel][pixel], the guard's blend of the pixel's own, of the pixels within 4 that show the
/// same surface, and of 1: a few samples say 1 where there is noise alone, and many samples say
/// what is so.
Planes place_gain(const std::array<std::array<const float*, 3>, 2>& sums,
                  const std::array<std::array<const float*, 3>, 2>& even_sums,
                  const PixelFacts& facts, const NoiseCorrelation& correlation);

inline constexpr int place_gain_reach = 4;

}  // namespace tessera
