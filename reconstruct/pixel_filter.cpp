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
    for (size_t i = 0; i < samples; ++i)
      weights.push_back(filter.weight((double(i) + 0.5) * step_ - 0.5 * width, width));
    values_.assign(samples + 1, 0.0);
    // Shifts within, as each has its own sum: the compiler makes vectors of them.
    for (size_t i = 0; i < samples; ++i)
      for (size_t shift = 0; i + shift < samples; ++shift)
        values_[shift] += weights[i] * weights[i + shift];
    for (double& value : values_) value *= step_;
  }

  double step() const { return step_; }
  /// At a distance in steps.
  double operator()(double position) const {
    if (!(position < double(samples))) return 0.0;
    const size_t i = size_t(position);
    return values_[i] + (position - double(i)) * (values_[i + 1] - values_[i]);
  }

 private:
  static constexpr size_t samples = 1024;
  double step_;
  std::vector<double> values_;
};

constexpr int intervals = 1024, directions = 64;

/// The overlap of the two-dimensional filter over distances in steps of `reach` / intervals,
/// averaged over the first `count` of the directions in a quadrant: the autocorrelation of a
/// product over the axes is the product of theirs, and the mean over one quadrant is that over all.
std::vector<double> mean_overlap(const AxisOverlap& x_overlap, const AxisOverlap& y_overlap,
                                 int count, double reach) {
  std::vector<double> overlap(intervals + 1, 0.0);
  for (int d = 0; d < count; ++d) {
    const double angle = 0.5 * std::numbers::pi * (d + 0.5) / directions;
    const double x = reach / intervals * std::cos(angle) / x_overlap.step();
    const double y = reach / intervals * std::sin(angle) / y_overlap.step();
    for (int i = 0; i <= intervals; ++i) overlap[size_t(i)] += x_overlap(i * x) * y_overlap(i * y);
  }
  for (double& value : overlap) value /= count;
  return overlap;
}

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
  const double reach = std::hypot(x_width, y_width);
  const AxisOverlap x_overlap(filter, x_width);
  // Of equal widths, directions to either side of the diagonal are alike.
  const std::vector<double> overlap =
      x_width == y_width ? mean_overlap(x_overlap, x_overlap, directions / 2, reach)
                         : mean_overlap(x_overlap, AxisOverlap(filter, y_width), directions, reach);
  return radius_holding(energy_share, overlap, reach);
}

}  // namespace tessera
