#include "reconstruct/sampling_rate.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tessera {
namespace {

constexpr double light_bandwidth = 4.0, pixel_bandwidth = std::numbers::pi, most_samples = 1e6;
/// Keeps the product of a shift and the bandwidth that it leaves a number.
constexpr double largest_shift_counted = 1e9;

double least_shift(const AxisWedge& wedge) {
  if (wedge.low <= 0 && wedge.high >= 0) return 0;
  return std::min(std::abs(double(wedge.low)), std::abs(double(wedge.high)));
}

double largest_shift(const AxisWedge& wedge) {
  return std::max(std::abs(double(wedge.low)), std::abs(double(wedge.high)));
}

double samples_along_axis(std::span<const EffectWedges> effects, AxisWedge EffectWedges::*axis) {
  double bandwidth = pixel_bandwidth;
  for (const EffectWedges& effect : effects)
    if (const double shift = least_shift(effect.*axis); shift > 0)
      bandwidth = std::min(bandwidth, light_bandwidth / std::min(shift, largest_shift_counted));
  double samples = 1;
  for (const EffectWedges& effect : effects) {
    const double shift = std::min(largest_shift(effect.*axis), largest_shift_counted);
    if (!(shift > 0)) continue;  // also a NaN
    samples *= std::max(1.0, (light_bandwidth + shift * bandwidth) / std::numbers::pi);
  }
  return std::min(samples, most_samples);  // before infinities are multiplied by zeros
}

}  // namespace

double samples_by_bound(std::span<const EffectWedges> effects) {
  const double samples =
      samples_along_axis(effects, &EffectWedges::x) * samples_along_axis(effects, &EffectWedges::y);
  return std::min(samples, most_samples);
}

}  // namespace tessera
