#pragma once
/// A grid that moves or is seen through an open lens: candidate samples of the whole grid are found
/// with interval bounds, then handed down to ever smaller blocks of micropolygons, and at last to
/// the coverage test.

#include <vector>

#include "hide/dual_bounds.h"
#include "hide/pixel_test_job.h"

namespace tessera {

/// Samples that a block of micropolygons may cover, copied together from wherever they lie in the
/// bucket, so that every vector of the tests below is full.
struct CandidateList {
  AlignedVector<float> x, y, u, v, t;
  AlignedVector<uint32_t> index;          ///< of the sample in the bucket
  AlignedVector<float> shear_x, shear_y;  ///< S of each, in the shear of a patch; only there
  size_t count = 0;

  /// Room for `capacity` candidates and a vector more.
  void reserve(size_t capacity);
  SampleArrays samples() const { return {x.data(), y.data(), u.data(), v.data(), t.data()}; }
};

/// Blocks of this many micropolygons a side are not cut further.
inline constexpr int patch_size = 4;

struct BlurScratch {
  std::vector<CandidateList> blocks;  ///< [depth]
  CandidateList patch, micropolygon;
};

struct BlurredGridJob {
  PixelTestJob test;
  const ClipGrid* clip = nullptr;
  const ClipSegment* segment = nullptr;
  PixelRect rect;  ///< the bucket
  SampleBox box;
  int tile_size = 4;              ///< pixels
  SampleInterval time_span;       ///< when the grid is between the clipping planes
  float t_first = 0, t_last = 1;  ///< only samples with t_first <= t <= t_last, with motion
  float z_nearest = 0;            ///< no hit on the segment is nearer
  uint32_t id0 = 0;               ///< of the grid's first triangle
  BlurScratch* scratch = nullptr;
  HideCounters* counters = nullptr;
};

/// Hides a block of the grid. Returns the number of micropolygons that were tested.
uint64_t hide_blurred_block(const BlurredGridJob& job, const GridBlock& block);

}  // namespace tessera
