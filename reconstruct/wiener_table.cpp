#include "reconstruct/wiener_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "reconstruct/wedge.h"
#include "reconstruct/wiener_model.h"

namespace tessera {
namespace {

/// Grid line i of the largest shift, pixels: 0, then half octaves from 1/2.
double shift_at(int i) { return i == 0 ? 0.0 : 0.5 * std::exp2(0.5 * (i - 1)); }
double shift_position(double shift) {
  return shift < 0.5 ? 2.0 * shift : 1.0 + 2.0 * std::log2(2.0 * shift);
}

/// Grid lines of low / high, closer where filters change fast.
constexpr std::array<double, 13> ratios = {-1.0, -0.7, -0.4, -0.2, 0.0, 0.1, 0.2,
                                           0.35, 0.5,  0.65, 0.8,  0.9, 1.0};
double ratio_position(double ratio) {
  size_t i = 0;
  while (i + 2 < ratios.size() && ratio >= ratios[i + 1]) ++i;
  return double(i) + (ratio - ratios[i]) / (ratios[i + 1] - ratios[i]);
}

double samples_at(int i) { return std::exp2(2.0 * i); }
double samples_position(double samples) { return 0.5 * std::log2(samples); }

/// Where a value lies on a grid: between `first` and the next line.
struct GridPlace {
  int first;
  double share;  ///< of the next line
  GridPlace(double position, int count) {
    const double bounded = std::clamp(position, 0.0, count - 1.0);
    first = std::min(int(bounded), count - 2);
    share = bounded - first;
  }
  double of(int i) const { return i == 0 ? 1.0 - share : share; }
};

/// How many samples a pixel one axis of a product should count on. The other axis, with a filter
/// like this one, shares noise among E pixels; and half of what a sample differs from the wanted
/// mean by is due to that other axis. So the axis sees noise as of n' = n E(n') / 2 samples, which
/// is solved for n' by interpolation: n' / E(n') grows with n'. (Measured in
/// docs/reconstruction.md.)
class PooledSamples {
 public:
  explicit PooledSamples(const WienerSolver& solver) {
    for (int i = 0; i < lines; ++i) {
      const double pooled = pooled_at(i);
      const double pixels = solver.equivalent_pixels(solver.weights(pooled));
      log_own_[size_t(i)] = std::log2(2.0 * pooled / pixels);
    }
  }
  double operator()(double own) const {
    const double wanted = std::log2(own);
    int i = 0;
    while (i + 2 < lines && wanted >= log_own_[size_t(i) + 1]) ++i;
    const double a = log_own_[size_t(i)], b = log_own_[size_t(i) + 1];
    return pooled_at(i) * std::pow(16.0, std::clamp((wanted - a) / (b - a), 0.0, 1.0));
  }

 private:
  static constexpr int lines = 6;
  static double pooled_at(int i) { return 0.25 * samples_at(2 * i); }
  std::array<double, size_t(lines)> log_own_{};
};

}  // namespace

WienerTable::WienerTable(int components, int image_axes)
    : components_(components),
      image_axes_(image_axes),
      size_(size_t(components * (2 * reach + 1))) {}

const WienerTable::Filters& WienerTable::filters(int shift, int ratio) const {
  Filters& wanted = grid_[size_t(shift * ratio_count + ratio)];
  std::call_once(wanted.solved, [&] {
    wanted.values = solve(ratios[size_t(ratio)] * shift_at(shift), shift_at(shift));
  });
  return wanted;
}

std::vector<float> WienerTable::solve(double low, double high) const {
  const PairStatistics pairs(low, high, components_, reach);
  const WienerSolver solver(pairs);
  std::optional<PooledSamples> pooled;
  if (image_axes_ == 2) pooled.emplace(solver);
  std::vector<float> filters;
  filters.reserve(size_t(samples_count) * size_);
  for (int k = 0; k < samples_count; ++k) {
    const double samples = pooled ? (*pooled)(samples_at(k)) : samples_at(k);
    const std::vector<double> filter = solver.weights(samples);
    filters.insert(filters.end(), filter.begin(), filter.end());
  }
  return filters;
}

void WienerTable::weights(const AxisWedge& wedge, double samples, float* out) const {
  const TurnedWedge turned = turned_wedge(bounded_wedge(wedge, float(max_shift)));
  const double ratio = turned.high > 0.0 ? std::clamp(turned.low / turned.high, -1.0, 1.0) : 0.0;
  const double bounded_samples = samples >= 1.0 ? std::min(samples, max_samples) : 1.0;
  const GridPlace at_shift(shift_position(turned.high), shift_count);
  const GridPlace at_ratio(ratio_position(ratio), ratio_count);
  const GridPlace at_samples(samples_position(bounded_samples), samples_count);
  std::fill(out, out + size_, 0.0f);
  for (int corner = 0; corner < 4; ++corner) {
    const int i = corner & 1, j = corner >> 1;
    const double wedge_share = at_shift.of(i) * at_ratio.of(j);
    if (wedge_share == 0.0) continue;
    const Filters& at = filters(at_shift.first + i, at_ratio.first + j);
    for (int k = 0; k < 2; ++k) {
      const float share = float(wedge_share * at_samples.of(k));
      const float* filter = at.values.data() + size_t(at_samples.first + k) * size_;
      for (size_t n = 0; n < size_; ++n) out[n] += share * filter[n];
    }
  }
  if (!turned.mirrored) return;
  const int row = 2 * reach + 1;
  for (int k = 1; k < components_; k += 2)
    for (int n = 0; n < row; ++n) out[k * row + n] = -out[k * row + n];
}

}  // namespace tessera
