#pragma once
/// How far the coverage test may round a depth out of the range of its corners.

#include <algorithm>
#include <cmath>

namespace tessera {

/// Relative to the largest |z| of the corners. The weights of a hit have one sign, so its depth is
/// a convex combination, off by the roundings of four sums, four products and a division: less than
/// 16 * 2^-24.
inline constexpr float depth_margin = 0x1p-20f;

/// A depth that no hit on a micropolygon with these corner depths is nearer than.
inline float nearest_depth(const float (&z)[4]) {
  const auto [low, high] = std::minmax({z[0], z[1], z[2], z[3]});
  return low - depth_margin * std::max(std::abs(low), std::abs(high));
}

}  // namespace tessera
