#pragma once
/// Weighted sums of one pixel's samples, in an order of addition that nothing changes.

#include <cstddef>

namespace tessera {

/// Channels summed at once: their accumulators and the weights stay in registers.
inline constexpr size_t sum_channels = 4;

/// The samples of one pixel of a footprint: filter weights towards the pixel that is summed, and
/// values.
struct PixelSamples {
  const float *wx, *wy;
  const float* channels[sum_channels];
  size_t count;  ///< samples
};

/// sums[0] = sum of wx[k] * wy[k], sums[1 + c] = sum of (wx[k] * wy[k]) * channels[c][k], over
/// the samples k of each of the `pixel_count` pixels. Sample k of every pixel adds to partial sum k
/// mod 8, pixels in the order given; a fixed tree adds up the eight, whatever the vector width. So
/// every target and every bucket size gives the same bits.
void sum_footprint(const PixelSamples* pixels, size_t pixel_count, double* sums);

/// Sums of products of two rows of values: sums[f * value_count + v] = sum of
/// weighted_factors[f][k]
/// * values[v][k] over k < count, a multiple of 8. Row r of either starts at its pointer + r *
/// stride. Partial sums as in sum_footprint().
void sum_products(const float* weighted_factors, size_t factor_count, const float* values,
                  size_t value_count, size_t stride, size_t count, double* sums);

/// out[k] = a[k] * b[k] for k < count, a multiple of 8.
void multiply(const float* a, const float* b, size_t count, float* out);

}  // namespace tessera
