/// The sample test: which samples of a vector see a micropolygon, and how deep. Every
/// point-sampling hider uses it, so on the same samples they agree bit for bit.
///
/// Included once for each SIMD target (Highway's foreach_target). All arithmetic is elementwise, so
/// it does not matter in which lane a sample stands or what stands beside it.
///
/// The test is clipless. A corner at the sample's time and lens position is (X, Y, W) in raster
/// clip space; relative to the sample at (x, y),
///
///   dx = X + u coc_x(z) - x W,   dy = Y + v coc_y(z) - y W,   e_ij = dx_i dy_j - dx_j dy_i.
///
/// The e of the three edges are, up to a common factor, the barycentric coordinates in camera space
/// of the point of the triangle's plane that the sample's line of sight meets: sum(e_k P_k)
/// projects to dx = dy = 0. The line of sight passes through the triangle exactly if they have one
/// sign. No division by W comes before that decision, so corners may be anywhere, behind the eye
/// included; a hit behind the eye is refused by its depth z = sum(e_k z_k) / sum(e_k).
///
/// e_ij is two products and a difference, never a fused multiply-add. Rounding is monotonic, so a
/// nonzero e has the exact sign (for the given dx and dy), and e_ij == -e_ji bit for bit. Zeros go
/// to the exact tie rule of hide/edge_sign.h, which is rare and scalar.

#include "hide/edge_sign.h"
#include "hide/quad.h"

#if defined(TESSERA_HIDE_COVERAGE_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TESSERA_HIDE_COVERAGE_H_
#undef TESSERA_HIDE_COVERAGE_H_
#else
#define TESSERA_HIDE_COVERAGE_H_
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::ScalableTag<float>;
using FloatVec = hn::Vec<FloatTag>;
using FloatMask = hn::Mask<FloatTag>;

/// One vector of samples. u, v are read only with a lens, t only with motion.
struct SampleVec {
  FloatVec x, y, u, v, t;
};

/// Corners a, b, c, d as seen from a vector of samples.
struct SeenQuad {
  FloatVec dx[4], dy[4], W[4], z[4];
};

/// Who sees the triangles, before depth is compared.
struct Coverage {
  FloatMask in0, in1;  ///< samples inside triangle 0 = (a, b, d) and triangle 1 = (a, d, c)
  FloatVec ab, bd, da, dc, ca;  ///< edge functions
};

/// Fragments of a vector of samples on one triangle each.
struct Hit {
  FloatMask mask;
  FloatVec z, b1, b2;
  FloatVec sum;         ///< of the edge functions; its sign tells the side that is seen
  FloatMask triangle1;  ///< which of the two triangles
};

/// Motion and lens are policies: what a frame does not have costs it nothing.
template <bool kMotion, bool kLens>
HWY_INLINE SeenQuad see(const CoverageFrame& f, const Quad& q, const SampleVec& s) {
  const FloatTag d;
  SeenQuad seen;
  FloatVec tau = hn::Zero(d);
  if constexpr (kMotion)
    tau = hn::Mul(hn::Sub(s.t, hn::Set(d, f.t_begin)), hn::Set(d, f.inverse_duration));
  const auto at_time = [&](float start, float delta) HWY_ATTR {
    if constexpr (kMotion) return hn::MulAdd(tau, hn::Set(d, delta), hn::Set(d, start));
    return hn::Set(d, start);
  };
  for (int k = 0; k < 4; ++k) {
    FloatVec X = at_time(q.X[k], q.dX[k]), Y = at_time(q.Y[k], q.dY[k]);
    seen.W[k] = at_time(q.W[k], q.dW[k]);
    seen.z[k] = at_time(q.z[k], q.dz[k]);
    if constexpr (kLens) {
      X = hn::MulAdd(
          s.u, hn::MulAdd(hn::Set(d, f.coc_x.scale), seen.z[k], hn::Set(d, f.coc_x.offset)), X);
      Y = hn::MulAdd(
          s.v, hn::MulAdd(hn::Set(d, f.coc_y.scale), seen.z[k], hn::Set(d, f.coc_y.offset)), Y);
    }
    seen.dx[k] = hn::NegMulAdd(s.x, seen.W[k], X);
    seen.dy[k] = hn::NegMulAdd(s.y, seen.W[k], Y);
  }
  return seen;
}

/// Decides the `tied` samples, those with an edge function of zero, exactly.
inline HWY_NOINLINE void settle_ties(const SeenQuad& q, FloatMask tied, Coverage& c) {
  const FloatTag d;
  constexpr size_t kMax = 16;
  HWY_ALIGN float dx[4][kMax], dy[4][kMax], W[4][kMax];
  HWY_ALIGN int32_t tie[kMax], in0[kMax], in1[kMax];
  const hn::RebindToSigned<FloatTag> di;
  for (int k = 0; k < 4; ++k) {
    hn::Store(q.dx[k], d, dx[k]);
    hn::Store(q.dy[k], d, dy[k]);
    hn::Store(q.W[k], d, W[k]);
  }
  hn::Store(hn::VecFromMask(di, hn::RebindMask(di, tied)), di, tie);
  hn::Store(hn::VecFromMask(di, hn::RebindMask(di, c.in0)), di, in0);
  hn::Store(hn::VecFromMask(di, hn::RebindMask(di, c.in1)), di, in1);
  for (size_t lane = 0; lane < hn::Lanes(d); ++lane) {
    if (!tie[lane]) continue;
    SeenVertex v[4];
    for (int k = 0; k < 4; ++k) v[k] = {dx[k][lane], dy[k][lane], W[k][lane]};
    const int ab = edge_sign(v[0], v[1]), bd = edge_sign(v[1], v[3]), da = edge_sign(v[3], v[0]);
    const int dc = edge_sign(v[3], v[2]), ca = edge_sign(v[2], v[0]);
    in0[lane] = -int(ab != 0 && ab == bd && ab == da);
    in1[lane] = -int(dc != 0 && dc == ca && dc == -da);
  }
  c.in0 = hn::RebindMask(d, hn::MaskFromVec(hn::Load(di, in0)));
  c.in1 = hn::RebindMask(d, hn::MaskFromVec(hn::Load(di, in1)));
}

HWY_INLINE FloatVec edge(const SeenQuad& q, int i, int j) {
  return hn::Sub(hn::Mul(q.dx[i], q.dy[j]), hn::Mul(q.dx[j], q.dy[i]));
}

/// False if no sample can be inside; otherwise `c` holds who is. A triangle's smallest edge
/// function times its largest is positive inside, negative outside, and zero (or, harmlessly, an
/// underflow to zero) where the tie rule decides.
HWY_INLINE bool find_inside(const SeenQuad& q, Coverage& c) {
  const FloatTag d;
  const FloatVec zero = hn::Zero(d);
  constexpr int A = 0, B = 1, C = 2, D = 3;
  c.ab = edge(q, A, B), c.bd = edge(q, B, D), c.da = edge(q, D, A);
  c.dc = edge(q, D, C), c.ca = edge(q, C, A);
  const FloatVec ad = hn::Neg(c.da);
  const FloatVec side0 =
      hn::Mul(hn::Min(hn::Min(c.ab, c.bd), c.da), hn::Max(hn::Max(c.ab, c.bd), c.da));
  const FloatVec side1 =
      hn::Mul(hn::Min(hn::Min(c.dc, c.ca), ad), hn::Max(hn::Max(c.dc, c.ca), ad));
  if (hn::AllTrue(d, hn::And(hn::Lt(side0, zero), hn::Lt(side1, zero)))) return false;
  c.in0 = hn::Gt(side0, zero), c.in1 = hn::Gt(side1, zero);
  const FloatMask tied = hn::Or(hn::Eq(side0, zero), hn::Eq(side1, zero));
  if (HWY_UNLIKELY(!hn::AllFalse(d, tied))) settle_ties(q, tied, c);
  return true;
}

/// Depth and barycentric coordinates on triangle 1 where `triangle1`, else on triangle 0.
HWY_INLINE Hit make_hit(const SeenQuad& q, const Coverage& c, FloatMask mask, FloatMask triangle1) {
  // Triangle 0 = (a, b, d) has weights bd, da, ab; triangle 1 = (a, d, c) has dc, ca, -da.
  const FloatVec w0 = hn::IfThenElse(triangle1, c.dc, c.bd);
  const FloatVec w1 = hn::IfThenElse(triangle1, c.ca, c.da);
  const FloatVec w2 = hn::IfThenElse(triangle1, hn::Neg(c.da), c.ab);
  const FloatVec z1 = hn::IfThenElse(triangle1, q.z[3], q.z[1]);
  const FloatVec z2 = hn::IfThenElse(triangle1, q.z[2], q.z[3]);
  const FloatVec sum = hn::Add(hn::Add(w0, w1), w2);
  const FloatVec z = hn::MulAdd(w2, z2, hn::MulAdd(w1, z1, hn::Mul(w0, q.z[0])));
  const FloatVec scale = hn::Div(hn::Set(FloatTag(), 1.0f), sum);
  return {mask, hn::Mul(z, scale), hn::Mul(w1, scale), hn::Mul(w2, scale), sum, triangle1};
}

/// Keeps of a hit what lies between the clipping planes, which are finite, and faces the camera; so
/// depths that are not finite go, and are tallied.
HWY_INLINE void keep_visible(const CoverageFrame& f, Hit& hit, CoverageCounts& counts) {
  const FloatTag d;
  FloatMask keep =
      hn::And(hn::Ge(hit.z, hn::Set(d, f.near_clip)), hn::Le(hit.z, hn::Set(d, f.far_clip)));
  keep = hn::And(keep, hn::Ge(hn::Mul(hit.sum, hn::Set(d, f.facing)), hn::Zero(d)));
  const FloatMask refused = hn::AndNot(keep, hit.mask);
  if (HWY_UNLIKELY(!hn::AllFalse(d, refused))) {
    const FloatMask finite = hn::Lt(hn::Abs(hit.z), hn::Set(d, hwy::HighestValue<float>()));
    counts.nonfinite += hn::CountTrue(d, hn::AndNot(finite, refused));
  }
  hit.mask = hn::And(hit.mask, keep);
}

/// Gives `sink(hit)` the fragments of the samples at `t` that `c` says are inside, of which the
/// first `remaining` count; the sink compares depths. A folded micropolygon may cover a sample with
/// both triangles, and then the sink is called for triangle 0 first. Of `seen`, only z is read.
template <bool kMotion, class Sink>
HWY_INLINE void report_hits(const CoverageFrame& f, const SeenQuad& seen, Coverage c, FloatVec t,
                            size_t remaining, CoverageCounts& counts, const Sink& sink) {
  const FloatTag d;
  if constexpr (kMotion) {
    const FloatMask owned =
        hn::And(hn::Ge(t, hn::Set(d, f.t_begin)), hn::Le(t, hn::Set(d, f.t_last)));
    c.in0 = hn::And(c.in0, owned), c.in1 = hn::And(c.in1, owned);
  }
  if (remaining < hn::Lanes(d)) {
    const FloatMask valid = hn::FirstN(d, remaining);
    c.in0 = hn::And(c.in0, valid), c.in1 = hn::And(c.in1, valid);
  }
  const FloatMask any = hn::Or(c.in0, c.in1);
  if (hn::AllFalse(d, any)) return;

  Hit hit = make_hit(seen, c, any, hn::AndNot(c.in0, c.in1));
  keep_visible(f, hit, counts);
  FloatMask covered = hit.mask;
  sink(hit);
  const FloatMask both = hn::And(c.in0, c.in1);
  if (HWY_UNLIKELY(!hn::AllFalse(d, both))) {
    Hit second = make_hit(seen, c, both, both);
    keep_visible(f, second, counts);
    covered = hn::Or(covered, second.mask);
    sink(second);
  }
  counts.covered += hn::CountTrue(d, covered);
}

/// Tests one vector of samples, of which the first `remaining` count, against a micropolygon, and
/// gives `sink(hit)` the fragments as report_hits() does.
template <bool kMotion, bool kLens, class Sink>
HWY_INLINE void test_vector(const CoverageFrame& f, const Quad& q, const SampleVec& s,
                            size_t remaining, CoverageCounts& counts, const Sink& sink) {
  const SeenQuad seen = see<kMotion, kLens>(f, q, s);
  Coverage c;
  if (find_inside(seen, c)) report_hits<kMotion>(f, seen, c, s.t, remaining, counts, sink);
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
