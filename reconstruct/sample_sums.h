#pragma once
/// Weighted sums of one pixel's samples, in an order of addition that nothing changes.

#include <cstddef>

namespace tessera {

/// Channels summed at once: their accumulators and the weights stay in registers.
inline constexpr size_t sum_channels = 4;

/// For k < count and c < sum_channels: sums[0] += sum wx[k] * wy[k], sums[1 + c] += sum of
/// (wx[k] * wy[k]) * channels[c][k]. Eight partial sums, lane k mod 8, are added up in a fixed
/// tree, whatever the vector width: every target and every bucket size gives the same bits.
void add_weighted_sums(const float* wx, const float* wy, const float* const* channels, size_t count,
                       double* sums);

}  // namespace tessera
