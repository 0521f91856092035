#pragma once
/// What a frame costs by its samples: a part whatever they are (start, dicing) and a part for each.

#include <algorithm>

namespace tessera::trade {

/// What one process took.
struct Pilot {
  int spp = 0;  ///< samples per pixel, above 0
  double wall_s = 0;
};

struct LinearCost {
  double fixed_s = 0;
  double sample_s = 0;  ///< for each sample per pixel

  /// From two of the same kind by rising samples; where both have as many, all is for samples. A
  /// sample takes at least a tenth of what the longer one's time is for each of its samples, as a
  /// difference may be noise, and at most all of it.
  static LinearCost from(const Pilot& first, const Pilot& last) {
    constexpr double least_share = 0.1;
    const double most_s = last.wall_s / last.spp;
    if (first.spp >= last.spp) return {0, most_s};
    const double slope_s = (last.wall_s - first.wall_s) / (last.spp - first.spp);
    const double sample_s = std::clamp(slope_s, least_share * most_s, most_s);
    return {last.wall_s - sample_s * last.spp, sample_s};
  }
  double of(int spp) const { return fixed_s + sample_s * spp; }
};

}  // namespace tessera::trade
