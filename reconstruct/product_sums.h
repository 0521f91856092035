#pragma once
/// Sums of products of carried channels over one pixel's footprint.

#include <vector>

#include "reconstruct/sample_block.h"

namespace tessera {

/// Gathers a footprint's carried channels next to each other, so that the sums of all products run
/// over a few kilobytes. One object serves pixel after pixel without allocating.
class ProductSums {
 public:
  explicit ProductSums(const std::vector<SampleProducts>& products);

  size_t count() const { return totals_.size(); }
  void clear() { samples_ = 0; }
  /// The samples of pixels [qx0, qx1) of row qy of `block`, weighted towards pixel (x, y).
  void add(const WeightedBlock& block, int x, int y, int qx0, int qx1, int qy);
  /// Every product's weighted mean over what was added; 0 without weight or where not finite.
  const std::vector<float>& finish();

 private:
  void reserve(size_t samples);
  float* row(size_t r) { return rows_.data() + r * stride_; }
  double weight_sum(size_t padded);

  const std::vector<SampleProducts>& products_;
  size_t channels_ = 0, max_factors_ = 0;
  size_t samples_ = 0, stride_ = 0;
  std::vector<float> rows_;  ///< [row][sample]: weights, carried channels, weighted factors
  std::vector<double> sums_;
  std::vector<float> totals_;
};

}  // namespace tessera
