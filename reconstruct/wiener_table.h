#pragma once
/// The best linear filters of wiener_model.h over wedges and sample counts, interpolated.

#include <array>
#include <cstddef>
#include <mutex>
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

  /// `components`: 1 to 7. `image_axes`: 1, or 2 for products of two such filters.
  WienerTable(int components, int image_axes);

  /// As ReconstructionMethod::weights(). Thread safe; filters are solved when first asked for,
  /// which takes some milliseconds, and kept.
  void weights(const AxisWedge& wedge, double samples, float* out) const;

 private:
  static constexpr int shift_count = 16, ratio_count = 13, samples_count = 9;
  /// The filters of a wedge, one a sample count.
  struct Filters {
    std::once_flag solved;
    std::vector<float> values;  ///< [samples][k][dx]
  };
  const Filters& filters(int shift, int ratio) const;
  std::vector<float> solve(double low, double high) const;

  int components_, image_axes_;
  size_t size_;                                                         ///< numbers of one filter
  mutable std::array<Filters, size_t(shift_count* ratio_count)> grid_;  ///< [shift][ratio]
};

}  // namespace tessera
