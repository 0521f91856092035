#pragma once
/// Pixels that are numbers, whatever their samples came to.

#include <cstdint>
#include <vector>

#include "images/image.h"
#include "shade/shade.h"

namespace tessera {

/// Sums of finite samples may leave the range of floats, and so may exposure. In the channels of
/// filtered groups puts the largest float, with its sign, for what is infinite, and 0 for what is
/// no number. Returns how many values that were. `image` has the channels of `groups` in their
/// order.
uint64_t bound_values(const std::vector<const AovDefinition*>& groups, Image& image);

}  // namespace tessera
