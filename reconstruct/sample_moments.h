#pragma once
/// From a bucket's samples to the channels that moments are summed from.

#include "reconstruct/method.h"
#include "reconstruct/moment_layout.h"
#include "reconstruct/pixel_facts.h"

namespace tessera {

/// Fills values.carried as `layout` says. `facts` holds the raw wedges of the bucket's pixels; a
/// sample's basis may depend on those of its own pixel. `color_group` is the place of "rgb" among
/// the groups; lens coordinates reach `spreads`.
void carry_moments(const MomentLayout& layout, const PixelFacts& facts, size_t color_group,
                   const SampleSpreads& spreads, SampleValues& values);

}  // namespace tessera
