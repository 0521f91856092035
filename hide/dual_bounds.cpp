#include "hide/dual_bounds.h"

#include <algorithm>
#include <cmath>

#include "hide/block_bounds.h"

namespace tessera {
namespace {

/// Cuts [from, to] down to the s with low <= slope * s <= high, a little generously: a root is off
/// by a few units in the last place.
void solve_between(float slope, float low, float high, float& from, float& to) {
  if (slope == 0) {
    if (low > 0 || high < 0) from = 1, to = 0;
    return;
  }
  float a = low / slope, b = high / slope;
  if (slope < 0) std::swap(a, b);
  const auto slack = [](float root) { return 0x1p-20f * (1 + std::abs(root)); };
  from = std::max(from, a - slack(a)), to = std::min(to, b + slack(b));
}

/// Cuts [from, to], within [0, 1], down to where the line from a (at 0) to b (at 1) is not
/// positive.
void clip_to_negative(float a, float b, float& from, float& to) {
  if (a <= 0 && b <= 0) return;
  if (a > 0 && b > 0) {
    from = 1, to = 0;
    return;
  }
  const float root = a / (a - b), slack = 0x1p-20f;
  if (a > 0)
    from = std::max(from, root - slack);
  else
    to = std::min(to, root + slack);
}

}  // namespace

SampleBox::SampleBox(const PixelRect& rect, float lens_extent)
    : middle{0.5f * float(rect.x0 + rect.x1), 0.5f * float(rect.y0 + rect.y1)},
      half{0.5f * float(rect.width()), 0.5f * float(rect.height())},
      lens(lens_extent * (1 + 0x1p-18f)) {}  // a profile may round a little past its extent

ShearFrame shear_frame(const ClipSegment& s, int u_count, const CoverageFrame& frame,
                       const SampleBox& box, const GridBlock& b) {
  const size_t row = size_t(u_count) + 1;
  const size_t corners[4] = {size_t(b.j0) * row + size_t(b.i0), size_t(b.j0) * row + size_t(b.i1),
                             size_t(b.j1) * row + size_t(b.i0), size_t(b.j1) * row + size_t(b.i1)};
  const float *positions[2] = {s.X, s.Y}, *changes[2] = {s.dX, s.dY};
  const AffineInZ* coc[2] = {&frame.coc_x, &frame.coc_y};
  ShearFrame f;
  for (int axis = 0; axis < 2; ++axis) {
    float W = 0, C = 0, V = 0, P = 0;
    for (const size_t i : corners) {
      const float half_t = s.dX ? 0.5f : 0.0f;
      W += 0.25f * (s.W[i] + (s.dX ? half_t * s.dW[i] : 0.0f));
      C += 0.25f * (*coc[axis])(s.z[i] + (s.dX ? half_t * s.dz[i] : 0.0f));
      V += s.dX ? 0.25f * (changes[axis][i] - box.middle[axis] * s.dW[i]) : 0.0f;
      P += std::abs(positions[axis][i]);
    }
    if (box.lens == 0) C = 0;
    f.per_p[axis] = W, f.per_l[axis] = -C, f.per_t[axis] = -V;
    f.margin[axis] =
        rounding_margin * (box.half[axis] * std::abs(W) + box.lens * std::abs(C) + std::abs(V) + P);
  }
  return f;
}

SampleInterval tile_interval(const BlockBounds& b, const SampleBox& box, int axis, float p_min,
                             float p_max) {
  const ShearFrame& f = b.shear;
  const float end0 = f.per_p[axis] * (p_min - box.middle[axis]);
  const float end1 = f.per_p[axis] * (p_max - box.middle[axis]);
  const float margin = f.margin[axis];
  const float low = b.low[axis] - std::max(end0, end1) - margin;
  const float high = b.high[axis] - std::min(end0, end1) + margin;
  const float lens_reach = box.lens * std::abs(f.per_l[axis]);
  SampleInterval i{0, 1, -box.lens, box.lens};
  solve_between(f.per_t[axis], low - lens_reach, high + lens_reach, i.t_min, i.t_max);
  solve_between(f.per_l[axis], low - std::max(f.per_t[axis], 0.0f),
                high - std::min(f.per_t[axis], 0.0f), i.l_min, i.l_max);
  return i;
}

SampleInterval depth_interval(const float (&z_min)[2], const float (&z_max)[2], float near_clip,
                              float far_clip) {
  SampleInterval interval;
  const float size =
      std::max({std::abs(z_min[0]), std::abs(z_min[1]), std::abs(z_max[0]), std::abs(z_max[1])});
  const float slack = rounding_margin * size;
  clip_to_negative(near_clip - z_max[0] - slack, near_clip - z_max[1] - slack, interval.t_min,
                   interval.t_max);
  clip_to_negative(z_min[0] - far_clip - slack, z_min[1] - far_clip - slack, interval.t_min,
                   interval.t_max);
  return interval;
}

}  // namespace tessera
