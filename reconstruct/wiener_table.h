#pragma once
/// The best linear filters of wiener_model.h over wedges and sample counts, interpolated.

#include <cstddef>
#include <vector>

#include "reconstruct/method.h"

namespace tessera {

/// Filters on a grid over the largest shift, the ratio of the two shifts and the samples a pixel;
/// linear in between, so that weights sum to 1 everywhere and change without jumps.
class WienerTable {
 public:
  static constexpr int reach = 16;              ///< pixels
  static constexpr double max_shift = 64.0;     ///< pixels; larger ones count as this
  static constexpr double max_samples = 65536;  ///< more count as this

  /// `components`: 1 to 7. `image_axes`: 1, or 2 for products of two such filters. Solves the whole
  /// grid.
  WienerTable(int components, int image_axes);

  /// As ReconstructionMethod::weights().
  void weights(const AxisWedge& wedge, double samples, float* out) const;

 private:
  /// Appends the filters of a wedge, one a sample count.
  void add_wedge(double low, double high, int image_axes);

  static constexpr int shift_count = 16, ratio_count = 13, samples_count = 9;
  const float* entry(int shift, int ratio, int samples) const {
    return &filters_[size_t((shift * ratio_count + ratio) * samples_count + samples) * size_];
  }

  int components_;
  size_t size_;                 ///< numbers of one filter
  std::vector<float> filters_;  ///< [shift][ratio][samples][k][dx]
};

}  // namespace tessera
