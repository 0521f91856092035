/// Bounds of vertices and blocks in sheared dual space (hide/dual_bounds.h). Included once for each
/// SIMD target.

#include <algorithm>
#include <cmath>

#include "hide/dual_bounds.h"

#ifndef TESSERA_HIDE_ROUNDING_MARGIN
#define TESSERA_HIDE_ROUNDING_MARGIN
namespace tessera {
/// Bound on all rounding in the bounds, in their evaluation and in dx of the coverage test,
/// relative to |X| + |u coc| + |x W|: fewer than 45 operations of 2^-24 each (docs/visibility.md).
inline constexpr float rounding_margin = 64 * 0x1p-24f;
}  // namespace tessera
#endif

#if defined(TESSERA_HIDE_BLOCK_BOUNDS_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_HIDE_BLOCK_BOUNDS_H_
#undef TESSERA_HIDE_BLOCK_BOUNDS_H_
#else
#define TESSERA_HIDE_BLOCK_BOUNDS_H_
#endif

#include <hwy/highway.h>

#include "hide/coverage.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {

struct VecRange {
  FloatVec low, high;
};

/// What a block's vertices have in common along one axis.
struct AxisJob {
  const float *P, *dP;  ///< X or Y
  AffineInZ coc;
  float middle, half, reach;  ///< reach: the largest |position|
  float per_p, per_l, per_t, margin;
};

inline AxisJob axis_job(const ClipSegment& s, const CoverageFrame& frame, const SampleBox& box,
                        const ShearFrame& shear, int axis) {
  return {axis ? s.Y : s.X,  axis ? s.dY : s.dX, axis ? frame.coc_y : frame.coc_x,
          box.middle[axis],  box.half[axis],     std::abs(box.middle[axis]) + box.half[axis],
          shear.per_p[axis], shear.per_l[axis],  shear.per_t[axis],
          shear.margin[axis]};
}

/// Range of delta + S over the box of samples, for the vertices i, i + 1, ... At either end of the
/// segment it is linear in p and l apart, so the extremes are the middle value -+ the half widths
/// times the slopes that the shear has left over.
template <bool kMotion, bool kLens>
HWY_INLINE VecRange vertex_range(const ClipSegment& s, const AxisJob& a, float lens, size_t i) {
  const FloatTag d;
  const auto ends = [&](FloatVec P, FloatVec W, FloatVec z, FloatVec& size) HWY_ATTR {
    const FloatVec at_middle = hn::NegMulAdd(hn::Set(d, a.middle), W, P);
    FloatVec spread = hn::Mul(hn::Set(d, a.half), hn::Abs(hn::Sub(hn::Set(d, a.per_p), W)));
    size = hn::MulAdd(hn::Set(d, a.reach), hn::Abs(W), hn::Abs(P));
    if constexpr (kLens) {
      const FloatVec lens_v = hn::Set(d, lens), scaled = hn::Mul(hn::Set(d, a.coc.scale), z);
      const FloatVec offset = hn::Set(d, a.coc.offset);
      const FloatVec left = hn::Add(hn::Add(scaled, offset), hn::Set(d, a.per_l));
      spread = hn::MulAdd(lens_v, hn::Abs(left), spread);
      size = hn::MulAdd(lens_v, hn::Add(hn::Abs(scaled), hn::Abs(offset)), size);
    }
    return VecRange{hn::Sub(at_middle, spread), hn::Add(at_middle, spread)};
  };
  const FloatVec P = hn::LoadU(d, a.P + i), W = hn::LoadU(d, s.W + i), z = hn::LoadU(d, s.z + i);
  FloatVec size;
  VecRange range = ends(P, W, z, size);
  if constexpr (kMotion) {
    FloatVec end_size;
    const VecRange end =
        ends(hn::Add(P, hn::LoadU(d, a.dP + i)), hn::Add(W, hn::LoadU(d, s.dW + i)),
             hn::Add(z, hn::LoadU(d, s.dz + i)), end_size);
    const FloatVec moved = hn::Set(d, a.per_t);
    range.low = hn::Min(range.low, hn::Add(end.low, moved));
    range.high = hn::Max(range.high, hn::Add(end.high, moved));
    size = hn::Max(size, end_size);
  }
  const FloatVec margin = hn::MulAdd(hn::Set(d, rounding_margin), size, hn::Set(d, a.margin));
  return {hn::Sub(range.low, margin), hn::Add(range.high, margin)};
}

/// Bounds of all vertices of a block.
template <bool kMotion, bool kLens>
BlockBounds bound_vertices(const ClipSegment& s, int u_count, const CoverageFrame& frame,
                           const SampleBox& box, const GridBlock& block) {
  const FloatTag d;
  const size_t row = size_t(u_count) + 1;
  BlockBounds bounds;
  bounds.shear = shear_frame(s, u_count, frame, box, block);
  for (int axis = 0; axis < 2; ++axis) {
    const AxisJob a = axis_job(s, frame, box, bounds.shear, axis);
    FloatVec low = hn::Set(d, hwy::HighestValue<float>()), high = hn::Neg(low);
    for (int j = block.j0; j <= block.j1; ++j) {
      const size_t first = size_t(j) * row + size_t(block.i0),
                   count = size_t(block.i1 - block.i0) + 1;
      for (size_t k = 0; k < count; k += hn::Lanes(d)) {
        const VecRange range = vertex_range<kMotion, kLens>(s, a, box.lens, first + k);
        const FloatMask valid = hn::FirstN(d, count - k);
        low = hn::IfThenElse(valid, hn::Min(low, range.low), low);
        high = hn::IfThenElse(valid, hn::Max(high, range.high), high);
      }
    }
    bounds.low[axis] = hn::GetLane(hn::MinOfLanes(d, low));
    bounds.high[axis] = hn::GetLane(hn::MaxOfLanes(d, high));
  }
  return bounds;
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
