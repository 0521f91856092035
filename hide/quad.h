#pragma once
/// What the coverage test (hide/coverage.h) is told: one micropolygon, and what all micropolygons
/// of a grid's segment have in common.

#include <cstdint>

#include "hide/clip_grid.h"
#include "hide/hide.h"

namespace tessera {

/// The corners a, b, c, d of a micropolygon (dice/grid.h) in raster clip space.
struct Quad {
  float X[4], Y[4], W[4], z[4];
  float dX[4], dY[4], dW[4], dz[4];  ///< set only if the segment moves
};

/// Common to the micropolygons of one segment of one grid.
struct CoverageFrame {
  AffineInZ coc_x, coc_y;
  float near_clip = 0, far_clip = 0;
  float t_begin = 0, inverse_duration = 1;
  float t_last = 1;  ///< the segment owns samples with t_begin <= t <= t_last
  float facing = 0;  ///< a triangle is seen if facing times its summed edges is >= 0; 0: both sides
};

/// Samples to test, as parallel arrays; u, v or t are null when the frame has no use for them.
struct SampleArrays {
  const float *x = nullptr, *y = nullptr, *u = nullptr, *v = nullptr, *t = nullptr;
};

/// Tallies of the coverage test.
struct CoverageCounts {
  uint64_t covered = 0, nonfinite = 0;
};

CoverageFrame coverage_frame(const HideInput& input, const Grid& grid, const ClipSegment& segment);
SampleArrays sample_arrays(const SampleBlock& block);

/// Micropolygon with its corner a at vertex (i, j).
inline Quad load_quad(const ClipSegment& s, int u_count, int i, int j) {
  const size_t row = size_t(u_count) + 1, a = size_t(j) * row + size_t(i);
  const size_t corner[4] = {a, a + 1, a + row, a + row + 1};
  Quad q;
  for (int k = 0; k < 4; ++k) {
    q.X[k] = s.X[corner[k]], q.Y[k] = s.Y[corner[k]];
    q.W[k] = s.W[corner[k]], q.z[k] = s.z[corner[k]];
  }
  if (s.dX)
    for (int k = 0; k < 4; ++k) {
      q.dX[k] = s.dX[corner[k]], q.dY[k] = s.dY[corner[k]];
      q.dW[k] = s.dW[corner[k]], q.dz[k] = s.dz[corner[k]];
    }
  return q;
}

}  // namespace tessera
