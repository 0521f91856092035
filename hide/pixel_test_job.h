#pragma once
/// Testing micropolygons against all samples of given pixels: what the job needs, and the entry
/// point that picks its specialisation and SIMD target.

#include "hide/fragment_buffer.h"
#include "hide/quad.h"

namespace tessera {

/// The samples of a bucket, one segment of one of its grids, and where its hits go.
struct PixelTestJob {
  CoverageFrame frame;
  SampleArrays samples;
  size_t samples_per_pixel = 0, pixels_per_row = 0;
  FragmentBuffer* buffer = nullptr;
  bool motion = false, lens = false, opaque = true;
  std::span<uint32_t> tests_per_pixel;  ///< as HideInput has it
};

PixelTestJob pixel_test_job(const HideInput& input, const ClipGrid& grid,
                            const ClipSegment& segment, bool opaque, FragmentBuffer& buffer);

/// Tests the samples of `pixels` (relative to the bucket's first pixel) against one micropolygon,
/// whose triangles are id0 and id0 + 1. Micropolygons must come in order of their ids.
void test_pixel_rect(const PixelTestJob& job, const Quad& quad, uint32_t id0,
                     const PixelRect& pixels, CoverageCounts& counts);

}  // namespace tessera
