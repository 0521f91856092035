#pragma once
/// The samples of a bucket arranged by strata of (u, v, t), as the modified Pixar method of Laine
/// et al. 2011, section 2, needs them.

#include <vector>

#include "base/aligned.h"
#include "hide/quad.h"
#include "hide/swept_box.h"

namespace tessera {

/// Strata along each axis of (u, v, t).
struct StrataCounts {
  int u = 1, v = 1, t = 1;
  int total() const { return u * v * t; }
};

/// Samples sorted by (stratum, pixel): within a stratum, those of a run of pixels in a row are one
/// run of samples. Reusable storage.
class StratifiedSamples {
 public:
  /// Cuts the lens, [-lens_extent, lens_extent] in u and v, and the shutter, [0, 1], into equal
  /// strata; where the block has no lens or time there is one along that axis.
  void set(const SampleBlock& block, const StrataCounts& wanted, float lens_extent);

  int count() const { return counts_.total(); }
  SampleArrays arrays() const;
  /// [arranged sample]: its index in the block.
  const uint32_t* index() const { return index_.data(); }
  /// First sample of pixel (x, y), relative to the block's first pixel, in a stratum; x may be one
  /// past the row's last.
  size_t first(int stratum, int x, int y) const {
    return offsets_[size_t(stratum) * pixels_ + size_t(y) * pixels_per_row_ + size_t(x)];
  }

  /// What a stratum spans, widened by the rounding of finding a sample's stratum, within a segment
  /// of the shutter. False if the two do not meet.
  bool range(int stratum, const CoverageFrame& frame, SweptRange& range) const;

 private:
  int stratum_of(const SampleBlock& block, size_t sample) const;

  StrataCounts counts_;
  double lens_extent_ = 1;
  bool lens_ = false;
  size_t pixels_ = 0, pixels_per_row_ = 0;
  AlignedVector<float> x_, y_, u_, v_, t_;
  AlignedVector<uint32_t> index_;
  std::vector<uint32_t> keys_;     // [sample]: stratum * pixels + pixel
  std::vector<uint32_t> offsets_;  // [key]: its first arranged sample
};

}  // namespace tessera
