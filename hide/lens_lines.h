#pragma once
/// Samples whose lens positions are on lines (SampleTuples::Kind::lens_lines), arranged by line:
/// within a line, a run of pixels of a row is a run of samples.

#include "hide/quad.h"
#include "hide/tct_bounds.h"

namespace tessera {

/// Reusable storage for the samples of one bucket.
class LensLines {
 public:
  /// Throws Error if a sample is on a line that is not below `line_count`.
  void arrange(const SampleBlock& block, int line_count);

  int line_count() const { return int(regions_.size()); }
  /// Where the samples of a line are on the lens. Measured, so it bounds whatever there is.
  const LensRegion& region(int line) const { return regions_[size_t(line)]; }
  /// Arranged index of the first sample of a pixel (row-major in the bucket) on a line; one past
  /// the last for the pixel after the last.
  size_t first(int line, size_t pixel) const { return first_[size_t(line) * pixels_ + pixel]; }
  SampleArrays samples() const;
  /// [arranged sample]: its index in the block.
  const uint32_t* index() const { return index_.data(); }

 private:
  void sort(const SampleBlock& block);
  void copy(const SampleBlock& block);
  LensRegion measure(int line) const;

  size_t pixels_ = 0;
  std::vector<size_t> first_;  // [line][pixel], and the number of samples
  std::vector<LensRegion> regions_;
  AlignedVector<uint32_t> index_;
  AlignedVector<float> x_, y_, u_, v_, t_;
};

}  // namespace tessera
