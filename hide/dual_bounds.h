#pragma once
/// Where and when a block of micropolygons can be seen: bounds in dual space.
///
/// A sight line through raster position x passes a vertex (X, W) at the distance
///   delta(x, u, t) = X(t) + u coc(z(t)) - x W(t)
/// (Laine et al., "Clipless Dual-Space Bounds for Faster Stochastic Rasterization", 2011, section
/// 3.2, equation 3; the coverage test calls it dx). A sample can be covered only if delta is not of
/// one sign over the vertices, delta_min <= 0 <= delta_max. Nothing is divided by W, so vertices
/// may be behind the eye. delta is linear in each of x, u and t with the others fixed.
///
/// The paper bounds delta by lines in x at both ends of the shutter and widens them by the circle
/// of confusion; that loses the oblique dependence on u and t of a surface that both moves and is
/// out of focus. Here delta is bounded between two parallel planes in (x, u, t). With W_m, C_m and
/// V_m a typical W, coc and d delta / d tau of the block, and p = x - x_middle, put
///
///   S(p, u, tau) = W_m p - C_m u - V_m tau.
///
/// delta + S is again linear in each variable, so its extremes over the box of samples and the
/// vertices of the block are at the corners of the box. A sample can be covered only if S lies
/// between them. S / W_m is the raster position carried back to shutter open and the lens centre:
/// blocks are boxes in that sheared space, and samples points.

#include "hide/quad.h"

namespace tessera {

/// The box of samples that bounds hold for: raster positions and lens coordinates.
struct SampleBox {
  float middle[2] = {0, 0}, half[2] = {1, 1};  ///< pixels, x and y
  float lens = 0;                              ///< |u|, |v| at most; 0 with a closed lens

  SampleBox() = default;
  SampleBox(const PixelRect& rect, float lens_extent);
};

/// Micropolygons [i0, i1) x [j0, j1) of a grid.
struct GridBlock {
  int i0 = 0, j0 = 0, i1 = 0, j1 = 0;
};

/// The sheared space of a block, for x (0) and y (1).
struct ShearFrame {
  float per_p[2], per_l[2], per_t[2];  ///< S = per_p p + per_l l + per_t tau
  float margin[2];                     ///< rounding of S
};

struct BlockBounds {
  ShearFrame shear;
  float low[2], high[2];  ///< a sample the block covers has low <= S <= high
};

/// Times and lens coordinates at which a block may be seen in a range of positions along one axis.
struct SampleInterval {
  float t_min = 0, t_max = 1;  ///< tau, in the segment
  float l_min = -1, l_max = 1;

  bool empty() const { return !(t_min <= t_max && l_min <= l_max); }
};

/// The shear that follows the corners of the block.
ShearFrame shear_frame(const ClipSegment& segment, int u_count, const CoverageFrame& frame,
                       const SampleBox& box, const GridBlock& block);

/// Bounds of the block in its own shear.
BlockBounds bound_block(const ClipSegment& segment, int u_count, const CoverageFrame& frame,
                        const SampleBox& box, const GridBlock& block);

/// Intervals along axis 0 (x, u) or 1 (y, v) for positions in [p_min, p_max] of a tile:
/// sections 3.1 and 3.2 of the paper. For tau the lens is taken at its worst (the paper's CoC
/// bias), and for the lens, tau; the tile by its ends (the half-tile bias).
SampleInterval tile_interval(const BlockBounds& bounds, const SampleBox& box, int axis, float p_min,
                             float p_max);

/// Times at which some of [z_min, z_max], linear between the ends of the segment, lies between the
/// clipping planes.
SampleInterval depth_interval(const float (&z_min)[2], const float (&z_max)[2], float near_clip,
                              float far_clip);

}  // namespace tessera
