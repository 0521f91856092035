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

void sum_footprint_simd(const PixelSamples* pixels, size_t pixel_count, size_t count,
                        double* sums) {
  const hn::CappedTag<float, logical_lanes> d;
  constexpr size_t lanes = hn::MaxLanes(d);
  constexpr size_t parts = logical_lanes / lanes;
  using V = hn::Vec<decltype(d)>;
  V totals[1 + sum_channels][parts];
  for (auto& total : totals)
    for (V& part : total) part = hn::Zero(d);
  float rest[1 + sum_channels][logical_lanes] = {};  // of samples beyond the last whole eight

  const size_t whole = count - count % logical_lanes;
  for (size_t q = 0; q < pixel_count; ++q) {
    const PixelSamples& pixel = pixels[q];
    for (size_t k = 0; k < whole; k += logical_lanes) {
      for (size_t p = 0; p < parts; ++p) {
        const size_t at = k + p * lanes;
        const V weight = hn::Mul(hn::LoadU(d, pixel.wx + at), hn::LoadU(d, pixel.wy + at));
        totals[0][p] = hn::Add(totals[0][p], weight);
        for (size_t c = 0; c < sum_channels; ++c)
          totals[1 + c][p] =
              hn::Add(totals[1 + c][p], hn::Mul(weight, hn::LoadU(d, pixel.channels[c] + at)));
      }
    }
    for (size_t k = whole; k < count; ++k) {
      const float weight = pixel.wx[k] * pixel.wy[k];
      rest[0][k - whole] += weight;
      for (size_t c = 0; c < sum_channels; ++c)
        rest[1 + c][k - whole] += weight * pixel.channels[c][k];
    }
  }
  for (size_t c = 0; c < 1 + sum_channels; ++c) {
    float partial[logical_lanes];
    for (size_t p = 0; p < parts; ++p) hn::StoreU(totals[c][p], d, partial + p * lanes);
    sums[c] = tree_sum(partial) + tree_sum(rest[c]);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tessera {

HWY_EXPORT(sum_footprint_simd);

void sum_footprint(const PixelSamples* pixels, size_t pixel_count, size_t count, double* sums) {
  HWY_DYNAMIC_DISPATCH(sum_footprint_simd)(pixels, pixel_count, count, sums);
}

}  // namespace tessera
#endif
