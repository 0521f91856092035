/// The vertices of a grid prepared for hide/dual_setup.h. Included once for each SIMD target.

#include <algorithm>
#include <cmath>

#include "hide/dual_grid.h"

#if defined(TESSERA_HIDE_DUAL_VERTICES_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_HIDE_DUAL_VERTICES_H_
#undef TESSERA_HIDE_DUAL_VERTICES_H_
#else
#define TESSERA_HIDE_DUAL_VERTICES_H_
#endif

#include <hwy/highway.h>

#include "hide/block_bounds.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {

/// x (0) or y (1) of a job.
struct DualAxis {
  const float *P, *dP;
  AffineInZ coc;
  float origin;  ///< raster position of the bucket's first pixel
  float reach;   ///< largest |position| at which bounds are evaluated
  int pixels;    ///< of the bucket
};

inline DualAxis dual_axis(const DualGridJob& job, int axis) {
  const int from = axis ? job.rect.y0 : job.rect.x0, to = axis ? job.rect.y1 : job.rect.x1;
  const CoverageFrame& f = job.test.frame;
  const ClipSegment& s = *job.segment;
  return {axis ? s.Y : s.X,
          axis ? s.dY : s.dX,
          axis ? f.coc_y : f.coc_x,
          float(from),
          float(std::max(std::abs(from), std::abs(to)) + job.tile_size),
          to - from};
}

inline void resize_vertices(const DualGridJob& job, bool motion, bool lens, DualVertices& v) {
  const size_t stored = padded(size_t(job.clip->grid().vertex_count())) + simd_padding;
  for (int axis = 0; axis < 2; ++axis) {
    for (int corner = 0; corner <= int(lens); ++corner)
      v.low[axis][corner].resize(stored), v.high[axis][corner].resize(stored);
    if (!motion) continue;
    v.P[axis].resize(stored), v.size[axis].resize(stored);
    for (auto& bias : v.bias[axis]) bias.resize(stored);
  }
  v.W_min.resize(stored);
  if (motion) v.W.resize(stored), v.z.resize(stored);
}

/// One axis of one vector of vertices, whose W and z at the ends are given.
///
/// The coverage test rounds the dx of a vertex by some units of 2^-24 of the vertex's `size`, at
/// the larger end; a vertex moved sideways by so much moves on screen by that over its W. The
/// bounds' own roundings are relative to no more than size / W too. rounding_margin covers all of
/// them.
template <bool kMotion, bool kLens>
HWY_INLINE void project_axis(const DualGridJob& job, const DualAxis& a, int axis, size_t i,
                             const FloatVec (&W)[2], const FloatVec (&z)[2]) {
  constexpr int kEnds = kMotion ? 2 : 1;
  const FloatTag d;
  DualVertices& out = job.scratch->vertices;
  const FloatVec lens = hn::Set(d, job.lens), half = hn::Set(d, 0.5f * float(job.tile_size));
  FloatVec P[2], shift[2], size = hn::Zero(d);
  P[0] = P[1] = hn::LoadU(d, a.P + i);
  if constexpr (kMotion) P[1] = hn::Add(P[0], hn::LoadU(d, a.dP + i));
  for (int end = 0; end < kEnds; ++end) {
    FloatVec own = hn::MulAdd(hn::Set(d, a.reach), hn::Abs(W[end]), hn::Abs(P[end]));
    shift[end] = hn::Zero(d);
    if constexpr (kLens) {
      const FloatVec scaled = hn::Mul(hn::Set(d, a.coc.scale), z[end]);
      const FloatVec offset = hn::Set(d, a.coc.offset);
      shift[end] = hn::Mul(lens, hn::Add(scaled, offset));
      own = hn::MulAdd(lens, hn::Add(hn::Abs(scaled), hn::Abs(offset)), own);
    }
    size = hn::Max(size, own);
  }
  const FloatVec error = hn::Mul(hn::Set(d, rounding_margin), size);
  for (int corner = 0; corner <= int(kLens); ++corner) {
    FloatVec low = hn::Set(d, hwy::HighestValue<float>()), high = hn::Neg(low);
    for (int end = 0; end < kEnds; ++end) {
      const FloatVec at = corner ? hn::Add(P[end], shift[end]) : hn::Sub(P[end], shift[end]);
      low = hn::Min(low, hn::Div(hn::Sub(at, error), W[end]));
      high = hn::Max(high, hn::Div(hn::Add(at, error), W[end]));
    }
    const FloatVec origin = hn::Set(d, a.origin);
    hn::StoreU(hn::Sub(low, origin), d, out.low[axis][corner].data() + i);
    hn::StoreU(hn::Sub(high, origin), d, out.high[axis][corner].data() + i);
  }
  if constexpr (kMotion) {
    hn::StoreU(P[1], d, out.P[axis].data() + i);
    hn::StoreU(size, d, out.size[axis].data() + i);
    for (int end = 0; end < 2; ++end)
      hn::StoreU(hn::MulAdd(half, hn::Abs(W[end]), hn::Abs(shift[end])), d,
                 out.bias[axis][end].data() + i);
  }
}

/// What W <= 0 makes of the raster positions is not used.
template <bool kMotion, bool kLens>
void project_vertices(const DualGridJob& job) {
  const FloatTag d;
  const ClipSegment& s = *job.segment;
  DualVertices& out = job.scratch->vertices;
  resize_vertices(job, kMotion, kLens, out);
  const DualAxis axes[2] = {dual_axis(job, 0), dual_axis(job, 1)};
  const auto count = size_t(job.clip->grid().vertex_count());
  for (size_t i = 0; i < count; i += hn::Lanes(d)) {
    FloatVec W[2], z[2];
    W[0] = W[1] = hn::LoadU(d, s.W + i), z[0] = z[1] = hn::LoadU(d, s.z + i);
    if constexpr (kMotion) {
      W[1] = hn::Add(W[0], hn::LoadU(d, s.dW + i)), z[1] = hn::Add(z[0], hn::LoadU(d, s.dz + i));
      hn::StoreU(W[1], d, out.W.data() + i), hn::StoreU(z[1], d, out.z.data() + i);
    }
    hn::StoreU(hn::Min(W[0], W[1]), d, out.W_min.data() + i);
    for (int axis = 0; axis < 2; ++axis)
      project_axis<kMotion, kLens>(job, axes[axis], axis, i, W, z);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
