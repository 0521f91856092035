#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "reconstruct/sample_sums.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "reconstruct/sample_sums.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr size_t logical_lanes = 8;

inline double tree_sum(const float* partial) {
  return double(((partial[0] + partial[4]) + (partial[2] + partial[6])) +
                ((partial[1] + partial[5]) + (partial[3] + partial[7])));
}

void add_weighted_sums_simd(const float* wx, const float* wy, const float* const* channels,
                            size_t count, double* sums) {
  const hn::CappedTag<float, logical_lanes> d;
  constexpr size_t lanes = hn::MaxLanes(d);
  constexpr size_t parts = logical_lanes / lanes;
  using V = hn::Vec<decltype(d)>;
  V totals[1 + sum_channels][parts];
  for (auto& total : totals)
    for (V& part : total) part = hn::Zero(d);

  size_t k = 0;
  for (; k + logical_lanes <= count; k += logical_lanes) {
    for (size_t p = 0; p < parts; ++p) {
      const size_t at = k + p * lanes;
      const V weight = hn::Mul(hn::LoadU(d, wx + at), hn::LoadU(d, wy + at));
      totals[0][p] = hn::Add(totals[0][p], weight);
      for (size_t c = 0; c < sum_channels; ++c)
        totals[1 + c][p] =
            hn::Add(totals[1 + c][p], hn::Mul(weight, hn::LoadU(d, channels[c] + at)));
    }
  }
  for (size_t c = 0; c < 1 + sum_channels; ++c) {
    float partial[logical_lanes];
    for (size_t p = 0; p < parts; ++p) hn::StoreU(totals[c][p], d, partial + p * lanes);
    for (size_t rest = k; rest < count; ++rest) {
      const float weight = wx[rest] * wy[rest];
      partial[rest - k] += c == 0 ? weight : weight * channels[c - 1][rest];
    }
    sums[c] += tree_sum(partial);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tessera {

HWY_EXPORT(add_weighted_sums_simd);

void add_weighted_sums(const float* wx, const float* wy, const float* const* channels, size_t count,
                       double* sums) {
  HWY_DYNAMIC_DISPATCH(add_weighted_sums_simd)(wx, wy, channels, count, sums);
}

}  // namespace tessera
#endif
