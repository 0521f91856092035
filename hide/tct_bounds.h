#pragma once
/// Where a micropolygon can be seen while it moves and is out of focus: an oriented box on the
/// raster, and the pixels of a bucket that it meets.

#include <span>
#include <vector>

#include "hide/quad.h"

namespace tessera {

/// Lens positions that samples have: within `box` along u and along v of the line from -(u, v) to
/// (u, v). All zero for a closed lens.
struct LensRegion {
  double u = 0, v = 0;
  double box = 0;
};

/// Pixels [x0, x1) of a row, relative to the bucket's first pixel.
struct PixelSpan {
  int y, x0, x1;
};

/// The corners of a micropolygon at both ends of a segment.
///
/// In front of the eye, a corner seen through one lens position moves along a straight line on the
/// raster, as a fraction of two linear functions of time does, and stays between its ends. So the
/// micropolygon stays within the convex hull of its corners at both ends, each grown by its circle
/// of confusion.
class SweptQuad {
 public:
  SweptQuad(const Quad& quad, const CoverageFrame& frame, bool moves, const PixelRect& rect);

  /// Nearer than the near plane or beyond the far plane all the time.
  bool is_clipped(const CoverageFrame& frame) const;

  /// Pixels of the bucket that a box around it meets for lens positions in `region`, a run for each
  /// row. The box is the smaller of two, along the mean motion of the corners on the raster and
  /// along that of the lens line (along x if there is none). If a corner is at or behind the eye at
  /// either end: every pixel, unless all corners are beyond one side of the bucket all the time.
  void find_spans(const LensRegion& region, std::vector<PixelSpan>& spans) const;

 private:
  struct Corner {
    double X, Y, W, z, cx, cy;
    double x_error, y_error;  // what the coverage test may round X - x W and Y - y W by
  };
  struct Box {
    double axis_x, axis_y;       // unit vector
    double along[2], across[2];  // range of axis . p, and of perpendicular . p; in the bucket
    bool empty() const { return along[1] < along[0] || across[1] < across[0]; }
    double area() const { return (along[1] - along[0]) * (across[1] - across[0]); }
  };

  bool beyond_a_side(const LensRegion& region) const;
  Box box_along(double axis_x, double axis_y, const LensRegion& region) const;
  Box smallest_box(const LensRegion& region) const;
  void rasterise(const Box& box, std::vector<PixelSpan>& spans) const;
  std::span<const Corner> corners() const { return {corners_, size_t(count_)}; }

  Corner corners_[8];  // a, b, c, d at the beginning, then at the end if it moves
  int count_;
  bool in_front_ = true;
  PixelRect rect_;
};

}  // namespace tessera
