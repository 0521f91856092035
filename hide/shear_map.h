#pragma once
/// The map that carries samples back to where a grid was: from a sample (x, y, u, v, t) to the
/// raster position that the same surface point has at a reference time, seen through the lens
/// centre. There the grid stands still and in focus, and its micropolygons are small boxes whatever
/// the blur (docs/visibility.md derives what follows).
///
/// With sigma the time since the reference, a vertex (X, Y, W) with rates (dX, dY, dW) is seen at
/// the distance delta from the sight line of x. Divided by its W at the reference time,
///
///   delta / W = x0 + sigma r + u (c + sigma e) - x (1 + sigma q),
///
/// where x0 is its raster position at the reference, r = dX / W, q = dW / W, c = coc / W and
/// e = d coc / d tau / W. Over a plane patch in linear motion r, q, c and e are affine functions of
/// (x0, y0), exactly; over a grid nearly so. With them replaced by an affine fit, delta = 0 for x
/// and y is a 2 x 2 linear system for (x0, y0): the map. What the fit leaves over bounds how far a
/// covered sample may land outside its micropolygon.
///
/// Raster positions here are relative to `middle`, so that little cancels.

#include "hide/dual_bounds.h"

namespace tessera {

/// at_middle + per_x * x0 + per_y * y0.
struct AffineField {
  float at_middle = 0, per_x = 0, per_y = 0;
};

/// What curvature adds to an affine field: constant + xx x0^2 + xy x0 y0 + yy y0^2.
struct BendField {
  float constant = 0, xx = 0, xy = 0, yy = 0;
};

/// The fields of one vertex, or the fit of each over a block.
enum ShearField { field_rx, field_ry, field_q, field_c, field_e, shear_fields };

struct ShearMap {
  float middle[2] = {0, 0};  ///< pixels; raster position that x0, y0 and x, y are relative to
  float tau = 0;             ///< reference time, within the segment
  float half_duration = 0;   ///< the map serves tau -+ this
  float coc_ratio = 1;       ///< coc_y / coc_x
  AffineField fit[shear_fields];
  BendField bend[shear_fields];
};

/// Times of a segment, as tau in [0, 1].
struct TimePiece {
  float begin = 0, end = 1;
};

/// Bound on |inverse of the system's matrix|, element by element: M with |x0 of the sample -
/// x0 of the surface| <= M times what the fit leaves over. `usable` is false where the matrix may
/// come near to being singular within the samples: surfaces that turn or are too steep.
struct ShearGain {
  float xx = 1, xy = 0, yx = 0, yy = 1;
  bool usable = false;
};

/// Fits the map to the vertices of a block for a piece of the segment's time. False if some vertex
/// that was looked at is not in front of the eye at the reference time.
bool fit_shear(const ClipSegment& segment, int u_count, const CoverageFrame& frame,
               const SampleBox& box, const GridBlock& block, const TimePiece& piece, ShearMap& map);

/// `reach` is the largest |x|, |y| of a sample relative to the map's middle.
ShearGain shear_gain(const ShearMap& map, float lens, const float (&reach)[2]);

/// Bounds on the coefficients of Q over all samples, [x, y].
struct BendBounds {
  float xx[2] = {0, 0}, xy[2] = {0, 0}, yy[2] = {0, 0};
};

BendBounds bend_bounds(const ShearMap& map, float lens, const float (&reach)[2]);

}  // namespace tessera
