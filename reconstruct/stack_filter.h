#pragma once
/// The image filter of one coordinate: two passes along the image axes, with weights that differ
/// from pixel to pixel.

#include <array>
#include <vector>

#include "reconstruct/method.h"
#include "reconstruct/moment_layout.h"
#include "reconstruct/pixel_facts.h"

namespace tessera {

/// Values of the pixels of a rectangle, row after row, with room for reads past the last.
using Planes = std::vector<std::vector<float>>;

/// How alike the noise of pixels d apart is, as they share samples of the pixel filter: 1 at d = 0.
struct NoiseCorrelation {
  static constexpr int reach = 3;
  std::array<float, reach + 1> x{1}, y{1};
};

struct StackFilterInput {
  const MomentStack* stack = nullptr;
  const Planes* planes = nullptr;     ///< as Film::take_products(), over the rectangle of `facts`,
                                      ///< with tap_run values of room at the end
  const PixelFacts* facts = nullptr;  ///< smoothed
  const std::vector<float>* shared = nullptr;  ///< 1: others may use the pixel; 0: an outlier
  NoiseCorrelation correlation;
  float wedge_width = 1;  ///< share of the way from the least shift to the largest that counts
};

struct StackFilterOutput {
  Planes values;  ///< [value of the stack] weighted sums, not normalised
  /// The weight of the pixel's own samples and, by correlation, its neighbours', not normalised.
  std::vector<float> own_weight;
};

/// The wedge from the least shift to `share` of the way to the largest, sign for sign; one that
/// holds 0 shrinks towards it.
inline AxisWedge narrowed(const AxisWedge& wedge, float share) {
  if (wedge.low >= 0) return {wedge.low, wedge.low + share * (wedge.high - wedge.low)};
  if (wedge.high <= 0) return {wedge.high - share * (wedge.high - wedge.low), wedge.high};
  return {share * wedge.low, share * wedge.high};
}

/// Steps along columns, then rows; for motion along the line of motion. Taps do not reach pixels of
/// another surface or whose normals differ by more than 20 degrees where the coordinate is that of
/// a ray effect.
StackFilterOutput filter_stack(const StackFilterInput& input);

/// The same along each pixel's own line (Blur::motion), at rounded places, for the pixels where
/// `wanted` is not 0.
StackFilterOutput filter_lines(const StackFilterInput& input, const std::vector<uint8_t>& wanted);

/// Whether a ray effect may be shared between two pixels: the same surface, and normals within 20
/// degrees (L. Wu et al. 2017, section 6.2).
inline bool alike(const PixelFacts& facts, size_t p, size_t q) {
  constexpr float cos_20_degrees = 0.9396926f;
  const float dot =
      facts.N[0][p] * facts.N[0][q] + facts.N[1][p] * facts.N[1][q] + facts.N[2][p] * facts.N[2][q];
  return facts.surface[p] == facts.surface[q] && dot >= cos_20_degrees;
}

}  // namespace tessera
