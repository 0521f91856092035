#include "hide/swept_box.h"

#include <algorithm>
#include <cmath>

namespace tessera {
namespace {

struct Interval {
  double min = INFINITY, max = -INFINITY;
  void add(double value) { min = std::min(min, value), max = std::max(max, value); }
};

/// Pixels of [0, size) that [min, max], relative to pixel 0, may touch; the test is written so that
/// a NaN keeps them all.
void clamp_pixels(double min, double max, int size, int& first, int& end) {
  first = min > 0 ? int(std::min(std::floor(min), double(size))) : 0;
  end = max < size ? int(std::max(0.0, std::floor(max) + 1.0)) : size;
}

}  // namespace

SweptRange whole_range(const HideInput& input) {
  SweptRange range;
  if (!input.features.lens) return range;
  const double E = double(input.lens_extent);
  range.u[0] = range.v[0] = -E, range.u[1] = range.v[1] = E;
  return range;
}

/// The coverage test rounds dx by less than 2^-18 of |X| + |x W| + |u coc| (docs/visibility.md
/// counts the operations) at the larger end of the whole segment, whatever part of it a box is for.
SweptBox::SweptBox(const HideInput& input, const Quad& quad, bool moves)
    : input_(input), quad_(quad), moves_(moves) {
  const PixelRect& rect = input.samples->rect;
  const auto& [coc_x, coc_y] = std::pair(input.raster_clip.coc_x, input.raster_clip.coc_y);
  const double E = input.features.lens ? double(input.lens_extent) : 0.0;
  double x_size = 0, y_size = 0, w_max = 0;
  for (int end = 0; end <= int(moves); ++end)
    for (int k = 0; k < 4; ++k) {
      const Corner c = corner_at(k, end);
      const double z = double(quad.z[k]) + (end ? double(quad.dz[k]) : 0.0);
      const double blur_x = E * (std::abs(coc_x.scale * z) + std::abs(coc_x.offset));
      const double blur_y = E * (std::abs(coc_y.scale * z) + std::abs(coc_y.offset));
      w_max = std::max(w_max, std::abs(c.W));
      x_size = std::max(x_size, std::abs(c.X) + blur_x);
      y_size = std::max(y_size, std::abs(c.Y) + blur_y);
    }
  constexpr double unit = 0x1p-18;
  x_rounding_ = unit * (x_size + std::max(std::abs(rect.x0), std::abs(rect.x1)) * w_max);
  y_rounding_ = unit * (y_size + std::max(std::abs(rect.y0), std::abs(rect.y1)) * w_max);
}

SweptBox::Corner SweptBox::corner_at(int k, double tau) const {
  const RasterClipMap& map = input_.raster_clip;
  const auto at = [&](const float* start, const float* delta) {
    return double(start[k]) + (moves_ ? tau * double(delta[k]) : 0.0);
  };
  const double z = at(quad_.z, quad_.dz);
  return {at(quad_.X, quad_.dX), at(quad_.Y, quad_.dY), at(quad_.W, quad_.dW),
          map.coc_x.scale * z + map.coc_x.offset, map.coc_y.scale * z + map.coc_y.offset};
}

/// A corner in front of the eye moves monotonically on screen between two times (linear motion
/// projects to a fraction of two linear functions of time), and linearly over the lens, so the
/// extremes are at the ends of the range. dx off by its rounding moves a corner on screen by that
/// over its W.
PixelRect SweptBox::pixels(const SweptRange& range) const {
  const PixelRect& rect = input_.samples->rect;
  Interval x, y;
  double w_min = INFINITY;
  for (int end = 0; end <= int(moves_); ++end)
    for (int k = 0; k < 4; ++k) {
      const Corner c = corner_at(k, range.tau[end]);
      for (const double u : range.u) x.add((c.X + u * c.coc_x) / c.W);
      for (const double v : range.v) y.add((c.Y + v * c.coc_y) / c.W);
      w_min = std::min(w_min, c.W);
    }
  if (!(w_min > 0)) return {0, 0, rect.width(), rect.height()};
  const double x_pad = x_rounding_ / w_min, y_pad = y_rounding_ / w_min;
  PixelRect r;
  clamp_pixels(x.min - x_pad - rect.x0, x.max + x_pad - rect.x0, rect.width(), r.x0, r.x1);
  clamp_pixels(y.min - y_pad - rect.y0, y.max + y_pad - rect.y0, rect.height(), r.y0, r.y1);
  return r;
}

}  // namespace tessera
