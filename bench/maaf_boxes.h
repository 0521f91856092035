#pragma once
/// Table 1 of L. Wu et al., EGSR 2017: how much of a filter made of boxes lies in the wedge.

#include <algorithm>
#include <cmath>
#include <vector>

#include "reconstruct/wedge_spectrum.h"

namespace tessera {

/// The share of the boxes' area (parallelograms where sheared; of one deviation to either side)
/// that lies in the wedge, summed over rows of equal y. Rows end where strips of 3, 5, 7, 25, 75
/// and 125 components do.
inline double summed_box_coverage(const DoubleWedge& wedge,
                                  const std::vector<SpectrumGaussian>& boxes) {
  constexpr int rows = 4 * 3 * 7 * 125;
  double area = 0, inside = 0;
  for (int row = 0; row < rows; ++row) {
    const double y = 2 * (row + 0.5) / rows - 1;
    const auto [first, last] = std::minmax({y / wedge.s_max, y / wedge.s_min});
    for (const SpectrumGaussian& box : boxes) {
      if (std::abs(y - box.y) > box.y_deviation) continue;
      const double middle = box.x + box.shear * (y - box.y);
      const double begin = middle - box.x_deviation, end = middle + box.x_deviation;
      area += end - begin;
      inside += std::max(0.0, std::min(end, last) - std::max(begin, first));
    }
  }
  return inside / area;
}

}  // namespace tessera
