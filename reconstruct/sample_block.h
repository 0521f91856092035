#pragma once
/// The samples of one bucket, ready to be summed by any pixel within the filter's reach.

#include <cstdint>
#include <vector>

#include "reconstruct/filter_table.h"
#include "reconstruct/reconstruct.h"

namespace tessera {

/// A bucket's samples with their filter weights: weights in x relative to the pixel `offset`
/// columns to the right of the sample's own, in y relative to the pixel `offset` rows below,
/// offsets from -reach to reach.
class WeightedBlock {
 public:
  /// Samples with a value that is not finite are left out and counted in `dropped`.
  WeightedBlock(SampleValues&& values, const std::vector<const AovDefinition*>& groups,
                const FilterTable& x_table, const FilterTable& y_table, uint64_t& dropped);

  const PixelRect& rect() const { return values_.rect; }
  int samples_per_pixel() const { return values_.samples_per_pixel; }
  size_t first_sample(int x, int y) const {
    return (size_t(y - rect().y0) * size_t(rect().width()) + size_t(x - rect().x0)) *
           size_t(samples_per_pixel());
  }
  const float* x_weights(int offset) const { return at(x_weights_, offset + x_reach_); }
  const float* y_weights(int offset) const { return at(y_weights_, offset + y_reach_); }
  /// Channel `c` of a group, one value a sample.
  const float* channel(size_t group, size_t c) const {
    return values_.groups[group].data() + c * sample_count_;
  }

 private:
  const float* at(const std::vector<float>& weights, int row) const {
    return weights.data() + size_t(row) * sample_count_;
  }
  bool finite(size_t sample) const;
  void drop_nonfinite(const std::vector<const AovDefinition*>& groups, uint64_t& dropped);

  SampleValues values_;
  size_t sample_count_;
  int x_reach_, y_reach_;
  std::vector<float> x_weights_, y_weights_;  ///< [offset][sample]
};

}  // namespace tessera
