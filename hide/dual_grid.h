#pragma once
/// A grid by the method of Laine et al., "Clipless Dual-Space Bounds for Faster Stochastic
/// Rasterization", 2011: for each micropolygon and each tile of pixels in its screen box, intervals
/// of the lens coordinates (section 3.1) and of time (section 3.2); the samples inside them are
/// tested.

#include <span>

#include "hide/pixel_test_job.h"

namespace tessera {

/// Per vertex of a grid's segment: what its micropolygons' bounds are made of. "End" is the
/// beginning (0) or the end (1) of the segment, "corner" the lens at -extent (0) or +extent (1).
struct DualVertices {
  AlignedVector<float> low[2][2], high[2][2];  ///< [axis][corner]: raster, pixels from the bucket's
  AlignedVector<float> size[2];     ///< [axis]: largest |X| + |u coc| + |x W|, for rounding
  AlignedVector<float> bias[2][2];  ///< [axis][end]: of delta, for lens and half tile
  AlignedVector<float> P[2], W, z;  ///< at end 1, if the segment moves
  AlignedVector<float> W_min;       ///< over both ends
};

/// Per column or row of tiles, for one micropolygon: lens coordinates and shutter times. t_min >
/// t_max: nothing to test.
struct TileIntervals {
  AlignedVector<float> l_min, l_max, t_min, t_max;
};

/// Samples to test, gathered from the tiles of one micropolygon so that vectors are full.
struct SampleBatch {
  static constexpr size_t capacity = 256, stored = capacity + simd_padding;
  alignas(64) float x[stored], y[stored], u[stored], v[stored], t[stored];
  alignas(64) uint32_t index[stored];  ///< in the bucket
  size_t count = 0;
};

/// Reusable storage of one thread.
struct DualScratch {
  DualVertices vertices;
  TileIntervals columns, rows;
  SampleBatch batch;
};

struct DualGridJob {
  PixelTestJob test;
  const ClipGrid* clip = nullptr;
  const ClipSegment* segment = nullptr;
  PixelRect rect;     ///< the bucket
  int tile_size = 1;  ///< pixels
  float lens = 0;     ///< largest |u|, |v|; 0 with a closed lens
  uint32_t id0 = 0;   ///< of the grid's first triangle
  std::span<uint32_t> tests_per_pixel;
  DualScratch* scratch = nullptr;
  HideCounters* counters = nullptr;
};

/// Returns the number of micropolygons that had samples to test.
uint64_t hide_dual_grid(const DualGridJob& job);

}  // namespace tessera
