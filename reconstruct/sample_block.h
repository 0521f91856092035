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
  size_t first_sample(int x, int y) const { return first_of(pixel(x, y)); }
  size_t sample_count(int x, int y) const {
    return first_of(pixel(x, y) + 1) - first_of(pixel(x, y));
  }
  const float* x_weights(int offset) const { return at(x_weights_, offset + x_reach_); }
  const float* y_weights(int offset) const { return at(y_weights_, offset + y_reach_); }
  /// Channel `c` of a group, one value a sample.
  const float* channel(size_t group, size_t c) const {
    return values_.groups[group].data() + c * sample_count_;
  }
  /// Carried channel `c`, one value a sample.
  const float* carried(size_t c) const { return values_.carried.data() + c * sample_count_; }

 private:
  const float* at(const std::vector<float>& weights, int row) const {
    return weights.data() + size_t(row) * sample_count_;
  }
  size_t pixel(int x, int y) const {
    return size_t(y - rect().y0) * size_t(rect().width()) + size_t(x - rect().x0);
  }
  size_t first_of(size_t p) const {
    return values_.first_of_pixel.empty() ? p * size_t(values_.samples_per_pixel)
                                          : values_.first_of_pixel[p];
  }
  template <class PixelOf>
  std::vector<float> axis_weights(const std::vector<float>& positions, const FilterTable& table,
                                  PixelOf pixel_of) const;
  void even_out_pixels();
  bool finite(size_t sample) const;
  void drop_nonfinite(const std::vector<const AovDefinition*>& groups, uint64_t& dropped);

  SampleValues values_;
  size_t sample_count_;
  int x_reach_, y_reach_;
  std::vector<float> x_weights_, y_weights_;  ///< [offset][sample]
};

}  // namespace tessera
