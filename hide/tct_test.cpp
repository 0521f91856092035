#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hide/tct_test.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "hide/pixel_test.h"
#include "hide/tct_test.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {

/// One polynomial at s.
template <bool kMotion>
HWY_INLINE FloatVec evaluate(const float (&coefficient)[3], FloatVec s) {
  const FloatTag d;
  const FloatVec constant = hn::Set(d, coefficient[0]);
  if constexpr (!kMotion) return constant;
  return hn::MulAdd(hn::MulAdd(hn::Set(d, coefficient[2]), s, hn::Set(d, coefficient[1])), s,
                    constant);
}

/// Edge function number `e` at samples whose x and y are relative to the reference point.
template <bool kMotion, bool kLens>
HWY_INLINE FloatVec edge_at(const TimeEdges& edges, int e, const SampleVec& at, FloatVec s) {
  const FloatTag d;
  const auto& c = edges.coefficient[e];
  using Edges = TimeEdges;
  FloatVec constant = evaluate<kMotion>(c[Edges::K], s);
  FloatVec per_y = evaluate<kMotion>(c[Edges::S], s), per_x = evaluate<kMotion>(c[Edges::U], s);
  if constexpr (kLens) {
    constant = hn::MulAdd(at.v, evaluate<kMotion>(c[Edges::P], s), constant);
    constant = hn::MulAdd(at.u, evaluate<kMotion>(c[Edges::Q], s), constant);
    per_y = hn::MulAdd(at.u, evaluate<kMotion>(c[Edges::T], s), per_y);
    per_x = hn::MulAdd(at.v, evaluate<kMotion>(c[Edges::V], s), per_x);
  }
  const FloatVec value = hn::NegMulAdd(at.x, per_x, hn::NegMulAdd(at.y, per_y, constant));
  return hn::IfThenElse(hn::Eq(value, hn::Zero(d)), hn::Set(d, edges.tie[e]), value);
}

HWY_INLINE FloatMask one_sign(FloatVec a, FloatVec b, FloatVec c) {
  const FloatTag d;
  const FloatVec zero = hn::Zero(d);
  return hn::Or(hn::Gt(hn::Min(hn::Min(a, b), c), zero), hn::Lt(hn::Max(hn::Max(a, b), c), zero));
}

template <bool kMotion, bool kLens>
HWY_INLINE bool find_inside_in_time(const TimeEdges& edges, SampleVec at, FloatVec s, Coverage& c) {
  const FloatTag d;
  at.x = hn::Sub(at.x, hn::Set(d, edges.x_reference));
  at.y = hn::Sub(at.y, hn::Set(d, edges.y_reference));
  const auto edge_number = [&](int e) HWY_ATTR { return edge_at<kMotion, kLens>(edges, e, at, s); };
  c.ab = edge_number(0), c.bd = edge_number(1), c.da = edge_number(2);
  c.dc = edge_number(3), c.ca = edge_number(4);
  c.in0 = one_sign(c.ab, c.bd, c.da), c.in1 = one_sign(c.dc, c.ca, hn::Neg(c.da));
  return !hn::AllFalse(d, hn::Or(c.in0, c.in1));
}

HWY_INLINE void record(const TctJob& job, uint32_t id0, size_t i, const Hit& hit) {
  FragmentBuffer& buffer = *job.buffer;
  if (job.opaque && !job.index) {
    store_opaque(hit, i, id0, buffer);
    return;
  }
  for_each_hit(hit, [&](size_t lane, float z, float b1, float b2, uint32_t triangle) {
    const size_t sample = job.index ? job.index[i + lane] : i + lane;
    if (job.opaque)
      buffer.put(sample, z, b1, b2, id0 + triangle);
    else
      buffer.add(sample, z, b1, b2, id0 + triangle);
  });
}

template <bool kMotion, bool kLens>
HWY_NOINLINE void test_runs(const TctJob& job, const TimeEdges& edges, uint32_t id0,
                            std::span<const SampleRun> runs, CoverageCounts& counts) {
  const FloatTag d;
  for (const SampleRun& run : runs)
    for (size_t i = run.begin; i < run.end; i += hn::Lanes(d)) {
      const SampleVec at = load_samples<kMotion, kLens>(job.samples, i);
      FloatVec s = hn::Zero(d);
      if constexpr (kMotion)
        s = hn::MulAdd(hn::Sub(at.t, hn::Set(d, job.frame.t_begin)),
                       hn::Set(d, job.frame.inverse_duration), hn::Set(d, -0.5f));
      Coverage c;
      if (!find_inside_in_time<kMotion, kLens>(edges, at, s, c)) continue;
      SeenQuad seen = {};
      for (int k = 0; k < 4; ++k) {
        seen.z[k] = hn::Set(d, edges.z[k]);
        if constexpr (kMotion) seen.z[k] = hn::MulAdd(s, hn::Set(d, edges.dz[k]), seen.z[k]);
      }
      report_hits<kMotion>(job.frame, seen, c, at.t, run.end - i, counts,
                           [&](const Hit& hit) HWY_ATTR { record(job, id0, i, hit); });
    }
}

void test_runs_any(const TctJob& job, const TimeEdges& edges, uint32_t id0,
                   std::span<const SampleRun> runs, CoverageCounts& counts) {
  if (job.motion)
    job.lens ? test_runs<true, true>(job, edges, id0, runs, counts)
             : test_runs<true, false>(job, edges, id0, runs, counts);
  else
    job.lens ? test_runs<false, true>(job, edges, id0, runs, counts)
             : test_runs<false, false>(job, edges, id0, runs, counts);
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tessera {

HWY_EXPORT(test_runs_any);

void test_time_edges(const TctJob& job, const TimeEdges& edges, uint32_t id0,
                     std::span<const SampleRun> runs, CoverageCounts& counts) {
  HWY_DYNAMIC_DISPATCH(test_runs_any)(job, edges, id0, runs, counts);
}

}  // namespace tessera
#endif
