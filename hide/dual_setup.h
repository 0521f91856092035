/// Bounds of a vector of micropolygons by Laine et al. 2011: screen boxes, and the lines from which
/// tiles get their intervals. Included once for each SIMD target.

#include "hide/eye_crossing.h"

#if defined(TESSERA_HIDE_DUAL_SETUP_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_HIDE_DUAL_SETUP_H_
#undef TESSERA_HIDE_DUAL_SETUP_H_
#else
#define TESSERA_HIDE_DUAL_SETUP_H_
#endif

#include "hide/dual_vertices.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {

/// More than what a root in [0, 1] is off by: a few units of 2^-24.
inline constexpr float root_slack = 0x1p-20f;

/// Bounds of as many micropolygons as a vector has lanes, [.., lane]. Positions are pixels from the
/// bucket's first; times are tau.
struct DualLanes {
  static constexpr size_t kMax = 16;
  alignas(64) float low[2][2][kMax], high[2][2][kMax];  // [axis][lens corner]
  alignas(64) int32_t first[2][kMax], last[2][kMax];    // [axis]: tiles that the box meets
  // The lens coordinate is <= scale * p + offset for lines 0, 1, >= it for 2, 3, at tile centre p.
  alignas(64) float lens_scale[2][4][kMax], lens_offset[2][4][kMax];
  // At tile `first` + n, at + n * step, for delta_min at end 0 and 1 and -delta_max at end 0 and 1.
  alignas(64) float delta_at[2][4][kMax], delta_step[2][4][kMax];
  alignas(64) float tau_min[kMax], tau_max[kMax];
};

struct TimeSpan {
  FloatVec min, max;
};

/// Cuts the span to where the line from a (at 0) to b (at 1) is not positive.
HWY_INLINE void clip_to_negative(FloatVec a, FloatVec b, TimeSpan& span) {
  const FloatTag d;
  const FloatVec zero = hn::Zero(d), root = hn::Div(a, hn::Sub(a, b));
  const FloatMask a_out = hn::Gt(a, zero), b_out = hn::Gt(b, zero);
  const FloatVec from =
      hn::IfThenElse(b_out, hn::Set(d, 2.0f), hn::Sub(root, hn::Set(d, root_slack)));
  span.min = hn::IfThenElse(a_out, hn::Max(span.min, from), span.min);
  span.max = hn::IfThenElse(hn::AndNot(a_out, b_out),
                            hn::Min(span.max, hn::Add(root, hn::Set(d, root_slack))), span.max);
}

HWY_INLINE FloatVec corner_min(const float* p, size_t row) {
  const FloatTag d;
  return hn::Min(hn::Min(hn::LoadU(d, p), hn::LoadU(d, p + 1)),
                 hn::Min(hn::LoadU(d, p + row), hn::LoadU(d, p + row + 1)));
}

HWY_INLINE FloatVec corner_max(const float* p, size_t row) {
  const FloatTag d;
  return hn::Max(hn::Max(hn::LoadU(d, p), hn::LoadU(d, p + 1)),
                 hn::Max(hn::LoadU(d, p + row), hn::LoadU(d, p + row + 1)));
}

/// Boxes at the lens corners and the time in the frustum, of lanes that cross the eye plane.
inline void box_crossing_lanes(const DualGridJob& job, int i, int j, uint32_t lanes, DualLanes& l) {
  const CoverageFrame& f = job.test.frame;
  const EyeView view{{f.coc_x, f.coc_y}, job.rect, job.lens, rounding_margin, job.test.motion};
  for (; lanes != 0; lanes &= lanes - 1) {
    const int n = __builtin_ctz(lanes);
    const EyeBox box =
        box_across_eye_plane(load_quad(*job.segment, job.clip->u_count(), i + n, j), view);
    for (int axis = 0; axis < 2; ++axis)
      for (int corner = 0; corner < 2; ++corner) {
        l.low[axis][corner][n] = box.low[axis][corner];
        l.high[axis][corner][n] = box.high[axis][corner];
      }
    l.tau_min[n] = box.tau[0], l.tau_max[n] = box.tau[1];
  }
}

/// Section 3.1: boxes around all corners of the micropolygon at both ends, for two lens corners.
template <bool kMotion, bool kLens>
HWY_INLINE void set_up_boxes(const DualGridJob& job, int i, int j, FloatMask valid, DualLanes& l) {
  const FloatTag d;
  const DualVertices& v = job.scratch->vertices;
  const size_t row = size_t(job.clip->u_count()) + 1, at = size_t(j) * row + size_t(i);
  for (int axis = 0; axis < 2; ++axis)
    for (int corner = 0; corner <= int(kLens); ++corner) {
      hn::Store(corner_min(v.low[axis][corner].data() + at, row), d, l.low[axis][corner]);
      hn::Store(corner_max(v.high[axis][corner].data() + at, row), d, l.high[axis][corner]);
    }
  hn::Store(hn::Zero(d), d, l.tau_min), hn::Store(hn::Set(d, 1.0f), d, l.tau_max);
  const FloatMask in_front = hn::Gt(corner_min(v.W_min.data() + at, row), hn::Zero(d));
  const FloatMask crossing = hn::AndNot(in_front, valid);
  if (HWY_LIKELY(hn::AllFalse(d, crossing))) return;
  uint8_t bits[8] = {};
  hn::StoreMaskBits(d, crossing, bits);
  box_crossing_lanes(job, i, j, uint32_t(bits[0] | bits[1] << 8), l);
}

/// Tiles that the boxes meet; who meets none in the bucket.
template <bool kLens>
HWY_INLINE FloatMask set_up_tiles(const DualGridJob& job, int axis, int pixels, DualLanes& l) {
  const FloatTag d;
  const hn::RebindToSigned<FloatTag> di;
  FloatVec low = hn::Load(d, l.low[axis][0]), high = hn::Load(d, l.high[axis][0]);
  if constexpr (kLens) {
    low = hn::Min(low, hn::Load(d, l.low[axis][1]));
    high = hn::Max(high, hn::Load(d, l.high[axis][1]));
  }
  const FloatVec zero = hn::Zero(d), end = hn::Set(d, float(pixels)),
                 last = hn::Set(d, float(pixels - 1));
  const FloatMask outside = hn::Or(hn::Or(hn::Lt(high, zero), hn::Ge(low, end)), hn::Gt(low, high));
  // Both are whole numbers below 2^16, so the quotient cannot round up to the next one.
  const FloatVec size = hn::Set(d, float(job.tile_size));
  const auto tile = [&](FloatVec position) HWY_ATTR {
    const FloatVec pixel = hn::Floor(hn::Min(hn::Max(position, zero), last));
    const FloatVec quotient = hn::Floor(hn::Div(pixel, size));
    return hn::ConvertTo(di, quotient);
  };
  hn::Store(tile(low), di, l.first[axis]), hn::Store(tile(high), di, l.last[axis]);
  return outside;
}

/// Section 3.1, equation 2: a box whose edge is at low + k (u + extent) has it at p for one u,
/// scale * p + offset; which side of that is inside depends on the edge and on the sign of k. An
/// edge that the lens does not move, or that is off at the edge of the screen, gives no bound.
HWY_INLINE void set_up_lens(const DualGridJob& job, int axis, DualLanes& l) {
  const FloatTag d;
  const FloatVec zero = hn::Zero(d), lens = hn::Set(d, job.lens);
  const FloatVec slack = hn::Set(d, job.lens * root_slack), far = hn::Set(d, 1e12f);
  const FloatVec half = hn::Set(d, 0.5f * float(job.tile_size));
  for (int high = 0; high < 2; ++high) {
    const auto& edge = high ? l.high[axis] : l.low[axis];
    const FloatVec grow = high ? half : hn::Neg(half);
    const FloatVec e0 = hn::Add(hn::Load(d, edge[0]), grow),
                   e1 = hn::Add(hn::Load(d, edge[1]), grow);
    const FloatVec moved = hn::Sub(e1, e0);
    const FloatMask useful = hn::And(hn::And(hn::Lt(hn::Abs(e0), far), hn::Lt(hn::Abs(e1), far)),
                                     hn::Gt(hn::Abs(moved), hn::Set(d, 1e-12f)));
    const FloatVec scale = hn::Div(hn::Add(lens, lens), moved);
    const FloatVec offset = hn::Mul(hn::Mul(hn::Set(d, -0.5f), hn::Add(e0, e1)), scale);
    const FloatMask rising = hn::And(useful, hn::Gt(moved, zero));
    const FloatMask falling = hn::AndNot(rising, useful);
    const FloatMask above = high ? falling : rising, below = high ? rising : falling;
    hn::Store(hn::IfThenElseZero(above, scale), d, l.lens_scale[axis][high]);
    hn::Store(hn::IfThenElse(above, hn::Add(offset, slack), lens), d, l.lens_offset[axis][high]);
    hn::Store(hn::IfThenElseZero(below, scale), d, l.lens_scale[axis][2 + high]);
    hn::Store(hn::IfThenElse(below, hn::Sub(offset, slack), hn::Neg(lens)), d,
              l.lens_offset[axis][2 + high]);
  }
}

/// Section 3.2: lines in x through the extremes of delta at the first and last tile centre. The
/// minimum over corners of functions linear in x is concave, and so lies above its chord; the
/// negated maximum does too.
HWY_INLINE void set_up_time(const DualGridJob& job, const DualAxis& a, int axis, size_t at,
                            DualLanes& l) {
  const FloatTag d;
  const hn::RebindToSigned<FloatTag> di;
  const DualVertices& v = job.scratch->vertices;
  const size_t row = size_t(job.clip->u_count()) + 1;
  const size_t corners[4] = {at, at + 1, at + row, at + row + 1};
  const FloatVec first = hn::ConvertTo(d, hn::Load(di, l.first[axis]));
  const FloatVec last = hn::ConvertTo(d, hn::Load(di, l.last[axis]));
  const FloatVec size = hn::Set(d, float(job.tile_size)), half = hn::Set(d, 0.5f);
  const FloatVec origin = hn::Set(d, a.origin), one = hn::Set(d, 1.0f);
  const FloatVec gamma[2] = {hn::MulAdd(hn::Add(first, half), size, origin),
                             hn::MulAdd(hn::Add(last, half), size, origin)};
  const FloatVec share = hn::Div(one, hn::Max(hn::Sub(last, first), one));
  const FloatVec error =
      hn::Mul(hn::Set(d, rounding_margin), corner_max(v.size[axis].data() + at, row));
  for (int end = 0; end < 2; ++end) {
    FloatVec min[2], max[2];
    min[0] = min[1] = hn::Set(d, hwy::HighestValue<float>());
    max[0] = max[1] = hn::Neg(min[0]);
    const float* P = end ? v.P[axis].data() : a.P;
    const float* W = end ? v.W.data() : job.segment->W;
    for (const size_t k : corners) {
      const FloatVec p = hn::LoadU(d, P + k), w = hn::LoadU(d, W + k);
      const FloatVec bias = hn::LoadU(d, v.bias[axis][end].data() + k);
      for (int g = 0; g < 2; ++g) {
        const FloatVec delta = hn::NegMulAdd(gamma[g], w, p);
        min[g] = hn::Min(min[g], hn::Sub(delta, bias));
        max[g] = hn::Max(max[g], hn::Add(delta, bias));
      }
    }
    const auto store = [&](int line, FloatVec begin, FloatVec final) HWY_ATTR {
      hn::Store(hn::Sub(begin, error), d, l.delta_at[axis][line]);
      hn::Store(hn::Mul(hn::Sub(final, begin), share), d, l.delta_step[axis][line]);
    };
    store(end, min[0], min[1]);
    store(2 + end, hn::Neg(max[0]), hn::Neg(max[1]));
  }
}

/// Cuts the time to that between the clipping planes.
template <bool kMotion>
HWY_INLINE FloatMask set_up_depth(const DualGridJob& job, size_t at, DualLanes& l) {
  const FloatTag d;
  const size_t row = size_t(job.clip->u_count()) + 1;
  const float* z[2] = {job.segment->z, kMotion ? job.scratch->vertices.z.data() : job.segment->z};
  FloatVec min[2], max[2], size = hn::Zero(d);
  for (int end = 0; end < 2; ++end) {
    min[end] = corner_min(z[end] + at, row), max[end] = corner_max(z[end] + at, row);
    size = hn::Max(size, hn::Max(hn::Abs(min[end]), hn::Abs(max[end])));
  }
  const FloatVec error = hn::Mul(hn::Set(d, rounding_margin), size);
  const FloatVec near = hn::Sub(hn::Set(d, job.test.frame.near_clip), error);
  const FloatVec far = hn::Add(hn::Set(d, job.test.frame.far_clip), error);
  TimeSpan span{hn::Load(d, l.tau_min), hn::Load(d, l.tau_max)};
  clip_to_negative(hn::Sub(near, max[0]), hn::Sub(near, max[1]), span);
  clip_to_negative(hn::Sub(min[0], far), hn::Sub(min[1], far), span);
  hn::Store(span.min, d, l.tau_min), hn::Store(span.max, d, l.tau_max);
  return hn::Gt(span.min, span.max);
}

/// Sets up micropolygons (i, j), (i + 1, j), ...; bits of those that may be seen in the bucket.
template <bool kMotion, bool kLens>
HWY_INLINE uint32_t set_up(const DualGridJob& job, const DualAxis (&axes)[2], int i, int j,
                           DualLanes& l) {
  const FloatTag d;
  const FloatMask valid = hn::FirstN(d, size_t(job.clip->u_count() - i));
  const size_t at = size_t(j) * (size_t(job.clip->u_count()) + 1) + size_t(i);
  set_up_boxes<kMotion, kLens>(job, i, j, valid, l);
  FloatMask outside = set_up_depth<kMotion>(job, at, l);
  for (int axis = 0; axis < 2; ++axis)
    outside = hn::Or(outside, set_up_tiles<kLens>(job, axis, axes[axis].pixels, l));
  const FloatMask seen = hn::AndNot(outside, valid);
  if (hn::AllFalse(d, seen)) return 0;
  for (int axis = 0; axis < 2; ++axis) {
    if constexpr (kLens) set_up_lens(job, axis, l);
    if constexpr (kMotion) set_up_time(job, axes[axis], axis, at, l);
  }
  uint8_t bits[8] = {};
  hn::StoreMaskBits(d, seen, bits);
  return uint32_t(bits[0] | bits[1] << 8);
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
