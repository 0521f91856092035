#pragma once
/// Bounds of a micropolygon with corners on both sides of the eye plane W = 0: "Vertices behind
/// camera plane" of Laine et al. 2011, section 3.1, and the time within the frustum of 3.2.

#include "hide/quad.h"

namespace tessera {

/// Raster positions no nearer than this are "at the edge of the screen or beyond".
inline constexpr float beyond_screen = 1e30f;

/// What the bounds are made for.
struct EyeView {
  AffineInZ coc[2];       ///< x, y
  PixelRect rect;         ///< the bucket
  float lens = 0;         ///< largest |u|, |v|; 0 with a closed lens
  float size_margin = 0;  ///< rounding of the coverage test's dx and dy, relative to their terms
  bool moves = false;
};

/// Boxes at the two lens corners, and the times (tau) at which the micropolygon may be in the
/// pyramid of the bucket's sight lines. Nothing can be seen if low > high or tau[0] > tau[1].
struct EyeBox {
  float low[2][2],
      high[2][2];  ///< [axis][lens at -extent, +extent]: pixels from the bucket's first
  float tau[2] = {0, 1};
};

EyeBox box_across_eye_plane(const Quad& quad, const EyeView& view);

}  // namespace tessera
