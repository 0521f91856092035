#pragma once
/// One grid seen by samples on fixed tuples (u, v, t): a 2D rasterisation for each tuple.

#include "hide/fragment_buffer.h"
#include "hide/quad.h"
#include "hide/tuple_samples.h"

namespace tessera {

/// The vertices of a grid at one tuple, and the micropolygons that may touch the bucket there.
/// Reusable.
struct TupleGridScratch {
  AlignedVector<float> X, Y, W, z;  ///< [vertex] raster clip space and camera depth
  AlignedVector<float> x, y;      ///< [vertex] raster position relative to the bucket's first pixel
  AlignedVector<uint32_t> index;  ///< [box] micropolygon
  AlignedVector<uint32_t> columns, rows;  ///< [box] first pixel, and the last << 16
  AlignedVector<float> nearest;           ///< [box] depth that no hit on it is nearer than
  size_t count = 0;
};

struct TupleGridJob {
  CoverageFrame frame;
  const ClipGrid* clip = nullptr;
  const ClipSegment* segment = nullptr;
  const TupleSamples* samples = nullptr;
  bool motion = false, lens = false, opaque = true;
  uint32_t id0 = 0;  ///< of the grid's first triangle
  /// Nearest opaque hits, in the order of `samples`.
  FragmentBuffer* opaque_hits = nullptr;
  /// Takes the other hits, by index into the bucket's SampleBlock.
  FragmentBuffer* fragments = nullptr;
  std::span<float> farthest;        ///< [tuple] farthest of its opaque hits; kept up to date
  std::span<uint8_t> met;           ///< [micropolygon] set to 1 if it met samples
  std::span<uint32_t> pixel_tests;  ///< [pixel] of the bucket; empty: nobody asks
  uint32_t samples_per_pixel = 1;
  TupleGridScratch* scratch = nullptr;
  HideCounters* counters = nullptr;
};

/// Tests the tuples whose time is in the segment.
void hide_tuple_grid(const TupleGridJob& job);

}  // namespace tessera
