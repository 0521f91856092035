#pragma once
/// A blurred grid whose micropolygons are larger than their blur: every sample in the box of pixels
/// that a micropolygon sweeps is tested, unless something opaque is known to be in front.

#include "hide/pixel_test_job.h"
#include "hide/tile_depth.h"

namespace tessera {

struct BoxedGridJob {
  const HideInput& input;
  const ClipGrid& clip;
  const ClipSegment& segment;
  const PixelTestJob& test;
  uint32_t id0;  ///< of the grid's first triangle
  const TileDepth& depth;
  HideCounters& counters;
};

/// Returns the number of micropolygons that were tested.
uint64_t hide_boxed_grid(const BoxedGridJob& job);

/// Area of the boxes of pixels that the grid's micropolygons sweep in this segment, over that of
/// the micropolygons: how many tests a covered sample costs. Estimated from a few micropolygons;
/// infinite if one of them meets the eye plane.
float swept_growth(const HideInput& input, const ClipGrid& clip, const ClipSegment& segment);

/// Grids that grow less than this are better boxed than sheared (`bench scaling`, the rows
/// little_blur, is where it was measured).
inline constexpr float boxed_growth = 8.0f;

}  // namespace tessera
