#pragma once
/// Boxes of pixels around all that a micropolygon sweeps over part of the shutter and of the lens:
/// the bounds of the baseline hiders.

#include "hide/hide.h"
#include "hide/quad.h"

namespace tessera {

/// Times and lens coordinates a box is made for. Times are tau, 0 to 1 over the segment.
struct SweptRange {
  double tau[2] = {0, 1};
  double u[2] = {0, 0}, v[2] = {0, 0};
};

/// All of a segment, and all of the lens if it is open.
SweptRange whole_range(const HideInput& input);

/// One micropolygon, boxed for any number of ranges. `moves`: the quad's deltas are set.
class SweptBox {
 public:
  SweptBox(const HideInput& input, const Quad& quad, bool moves);

  /// Pixels, relative to the bucket's first, that the micropolygon may touch within `range`; all of
  /// the bucket if a corner is at or behind the eye plane at either end of it.
  PixelRect pixels(const SweptRange& range) const;

 private:
  /// A corner in raster clip space and, per unit lens coordinate, its blur.
  struct Corner {
    double X, Y, W, coc_x, coc_y;
  };
  Corner corner_at(int k, double tau) const;

  const HideInput& input_;
  const Quad& quad_;
  bool moves_;
  double x_rounding_, y_rounding_;  // of dx and dy in the coverage test
};

}  // namespace tessera
