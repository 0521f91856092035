#include "reconstruct/pixel_filter.h"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "cameras/spectrum.h"

namespace tessera {
namespace {

/// Integral of weight(x) weight(x + s) over x, for distances s in [0, width].
class AxisOverlap {
 public:
  AxisOverlap(const PixelFilterDefinition& filter, double width) : step_(width / samples) {
    // Midpoints stay within the part where both factors are smooth, whatever whole number of steps
    // s is: jumps at the ends of the width and kinks at 0 fall between them.
    std::vector<double> weights;
    for (int i = 0; i < samples; ++i)
      weights.push_back(filter.weight((i + 0.5) * step_ - 0.5 * width, width));
    for (int shift = 0; shift <= samples; ++shift) {
      double sum = 0.0;
      for (int i = 0; i + shift < samples; ++i)
        sum += weights[size_t(i)] * weights[size_t(i + shift)];
      values_.push_back(sum * step_);
    }
  }

  double operator()(double distance) const {
    const double position = distance / step_;
    if (!(position < samples)) return 0.0;
    const size_t i = size_t(position);
    return std::lerp(values_[i], values_[i + 1], position - double(i));
  }

 private:
  static constexpr int samples = 1024;
  double step_;
  std::vector<double> values_;
};

}  // namespace

const PixelFilterDefinition& find_pixel_filter(std::string_view name) {
  std::string choices;
  for (const PixelFilterDefinition& filter : pixel_filter_registry()) {
    if (name == filter.name) return filter;
    choices += fmt::format("{}{}", choices.empty() ? "" : ", ", filter.name);
  }
  throw Error(fmt::format("unknown pixel filter '{}': expected one of {}", name, choices));
}

double pixel_filter_band_limit(const PixelFilterDefinition& filter, double x_width, double y_width,
                               double energy_share) {
  check_energy_share(energy_share);
  for (double width : {x_width, y_width}) {
    if (!(width > 0.0 && std::isfinite(width)))
      throw Error(fmt::format("band limit of pixel filter {}: width {} is not a positive number",
                              filter.name, width));
  }
  // The autocorrelation of a product over the axes is the product of theirs; the mean over one
  // quadrant of directions is that over all.
  constexpr int intervals = 1024, directions = 64;
  const AxisOverlap x_overlap(filter, x_width), y_overlap(filter, y_width);
  const double reach = std::hypot(x_width, y_width);
  std::vector<double> overlap(intervals + 1, 0.0);
  for (int d = 0; d < directions; ++d) {
    const double angle = 0.5 * std::numbers::pi * (d + 0.5) / directions;
    const double x = reach / intervals * std::cos(angle), y = reach / intervals * std::sin(angle);
    for (int i = 0; i <= intervals; ++i)
      overlap[size_t(i)] += x_overlap(i * x) * y_overlap(i * y) / directions;
  }
  return radius_holding(energy_share, overlap, reach);
}

}  // namespace tessera
