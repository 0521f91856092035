#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "reconstruct/weighted_taps.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "reconstruct/weighted_taps.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Each pixel has a lane of its own, so the width of vectors changes no sum. Two vectors at a time
/// hide the latency of addition.
void sum_taps_simd(const TapTerm* terms, size_t term_count, const TapWeights& weights,
                   size_t tap_stride, float* out) {
  const hn::CappedTag<float, tap_run / 2> d;
  const size_t lanes = hn::Lanes(d);
  for (size_t x = 0; x < tap_run; x += 2 * lanes) {
    auto left = hn::Zero(d), right = hn::Zero(d);
    for (size_t i = 0; i < term_count; ++i) {
      const float* w = weights.values + terms[i].function * weights.taps * tap_run + x;
      const float* m = terms[i].first + x;
      for (size_t t = weights.tap_begin; t < weights.tap_end; ++t) {
        const float *wt = w + t * tap_run, *mt = m + t * tap_stride;
        left = hn::Add(left, hn::Mul(hn::LoadU(d, wt), hn::LoadU(d, mt)));
        right = hn::Add(right, hn::Mul(hn::LoadU(d, wt + lanes), hn::LoadU(d, mt + lanes)));
      }
    }
    hn::StoreU(left, d, out + x);
    hn::StoreU(right, d, out + x + lanes);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tessera {

HWY_EXPORT(sum_taps_simd);

void sum_taps(const TapTerm* terms, size_t term_count, const TapWeights& weights, size_t tap_stride,
              float* out) {
  HWY_DYNAMIC_DISPATCH(sum_taps_simd)(terms, term_count, weights, tap_stride, out);
}

}  // namespace tessera
#endif
