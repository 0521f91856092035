#pragma once
/// Images of several passes as one.

#include <span>

#include "images/image.h"
#include "shade/shade.h"

namespace tessera {

/// Where `from` saw something nearer, its channels that must not be averaged (ids, depth) replace
/// those of `to`. Both have the channels of `groups`, in their order.
void take_closest(std::span<const AovDefinition* const> groups, const Image& from, Image& to);

/// The channels that are filtered become `share` of `from` and the rest of `to`.
void average(std::span<const AovDefinition* const> groups, const Image& from, double share,
             Image& to);

}  // namespace tessera
