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

void sum_footprint_simd(const PixelSamples* pixels, size_t pixel_count, double* sums) {
  const hn::CappedTag<float, logical_lanes> d;
  constexpr size_t lanes = hn::MaxLanes(d);
  constexpr size_t parts = logical_lanes / lanes;
  using V = hn::Vec<decltype(d)>;
  V totals[1 + sum_channels][parts];
  for (auto& total : totals)
    for (V& part : total) part = hn::Zero(d);
  float rest[1 + sum_channels][logical_lanes] = {};  // of samples beyond the last whole eight

  for (size_t q = 0; q < pixel_count; ++q) {
    const PixelSamples& pixel = pixels[q];
    const size_t count = pixel.count, whole = count - count % logical_lanes;
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

/// A block of 2 rows of factors by 4 rows of values: 8 sums in registers.
void sum_block(const float* const (&f)[2], const float* const (&v)[4], size_t count,
               double (&sums)[2][4]) {
  const hn::CappedTag<float, logical_lanes> d;
  constexpr size_t lanes = hn::MaxLanes(d);
  constexpr size_t parts = logical_lanes / lanes;
  using V = hn::Vec<decltype(d)>;
  V totals[2][4][parts];
  for (auto& row : totals)
    for (auto& total : row)
      for (V& part : total) part = hn::Zero(d);
  for (size_t k = 0; k < count; k += logical_lanes) {
    for (size_t p = 0; p < parts; ++p) {
      const size_t at = k + p * lanes;
      const V f0 = hn::LoadU(d, f[0] + at), f1 = hn::LoadU(d, f[1] + at);
      for (size_t c = 0; c < 4; ++c) {
        const V value = hn::LoadU(d, v[c] + at);
        totals[0][c][p] = hn::Add(totals[0][c][p], hn::Mul(f0, value));
        totals[1][c][p] = hn::Add(totals[1][c][p], hn::Mul(f1, value));
      }
    }
  }
  for (size_t a = 0; a < 2; ++a)
    for (size_t c = 0; c < 4; ++c) {
      float partial[logical_lanes];
      for (size_t p = 0; p < parts; ++p) hn::StoreU(totals[a][c][p], d, partial + p * lanes);
      sums[a][c] = tree_sum(partial);
    }
}

/// Blocks that reach past the end repeat the last row, and the repeats go nowhere.
void sum_products_simd(const float* factors, size_t factor_count, const float* values,
                       size_t value_count, size_t stride, size_t count, double* sums) {
  for (size_t f = 0; f < factor_count; f += 2) {
    const size_t f1 = HWY_MIN(f + 1, factor_count - 1);
    const float* const rows[2] = {factors + f * stride, factors + f1 * stride};
    for (size_t v = 0; v < value_count; v += 4) {
      const float* columns[4];
      for (size_t c = 0; c < 4; ++c) columns[c] = values + HWY_MIN(v + c, value_count - 1) * stride;
      double block[2][4];
      sum_block(rows, {columns[0], columns[1], columns[2], columns[3]}, count, block);
      for (size_t c = 0; c < 4 && v + c < value_count; ++c) {
        sums[f * value_count + v + c] = block[0][c];
        if (f + 1 < factor_count) sums[(f + 1) * value_count + v + c] = block[1][c];
      }
    }
  }
}

void multiply_simd(const float* a, const float* b, size_t count, float* out) {
  const hn::CappedTag<float, logical_lanes> d;
  for (size_t k = 0; k < count; k += hn::MaxLanes(d))
    hn::StoreU(hn::Mul(hn::LoadU(d, a + k), hn::LoadU(d, b + k)), d, out + k);
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tessera {

HWY_EXPORT(sum_footprint_simd);
HWY_EXPORT(sum_products_simd);
HWY_EXPORT(multiply_simd);

void sum_footprint(const PixelSamples* pixels, size_t pixel_count, double* sums) {
  HWY_DYNAMIC_DISPATCH(sum_footprint_simd)(pixels, pixel_count, sums);
}

void sum_products(const float* weighted_factors, size_t factor_count, const float* values,
                  size_t value_count, size_t stride, size_t count, double* sums) {
  HWY_DYNAMIC_DISPATCH(sum_products_simd)
  (weighted_factors, factor_count, values, value_count, stride, count, sums);
}

void multiply(const float* a, const float* b, size_t count, float* out) {
  HWY_DYNAMIC_DISPATCH(multiply_simd)(a, b, count, out);
}

}  // namespace tessera
#endif
