#pragma once
/// A grid that neither moves nor is seen through an open lens: bounds are boxes of pixels.

#include "hide/pixel_test_job.h"
#include "hide/tile_depth.h"

namespace tessera {

/// Micropolygons that may touch the bucket, with their boxes of pixels. Reusable.
struct PixelBoxes {
  AlignedVector<float> x, y;      ///< [vertex] raster position relative to the bucket's first pixel
  AlignedVector<uint32_t> index;  ///< [box] micropolygon
  AlignedVector<uint32_t> columns;  ///< [box] first column of pixels, and the last << 16
  AlignedVector<uint32_t> rows;     ///< [box] first row of strips, and the last << 16
  size_t count = 0;
};

struct StaticGridJob {
  PixelTestJob test;
  const ClipGrid* clip = nullptr;
  PixelRect rect;             ///< the bucket
  uint32_t id0 = 0;           ///< of the grid's first triangle
  bool y_stratified = false;  ///< as SampleBlock has it
  int strips_per_pixel = 1;   ///< set by hide_static_grid; rows of boxes are this much finer
  const TileDepth* depth = nullptr;
  PixelBoxes* boxes = nullptr;
  HideCounters* counters = nullptr;
};

/// Returns the number of micropolygons that were tested.
uint64_t hide_static_grid(const StaticGridJob& job);

}  // namespace tessera
