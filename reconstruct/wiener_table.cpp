#include "reconstruct/wiener_table.h"

#include <algorithm>
#include <cmath>

#include "reconstruct/wedge.h"
#include "reconstruct/wiener_model.h"

namespace tessera {
namespace {

/// Grid line i of the largest shift, pixels: 0, then half octaves from 1/2.
double shift_at(int i) { return i == 0 ? 0.0 : 0.5 * std::exp2(0.5 * (i - 1)); }
double shift_position(double shift) {
  return shift < 0.5 ? 2.0 * shift : 1.0 + 2.0 * std::log2(2.0 * shift);
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

}  // namespace

WienerTable::WienerTable(int components)
    : components_(components), size_(size_t(components * (2 * reach + 1))) {
  filters_.reserve(size_t(shift_count * ratio_count * samples_count) * size_);
  for (int i = 0; i < shift_count; ++i) {
    for (int j = 0; j < ratio_count; ++j) {
      const double high = std::min(shift_at(i), max_shift);
      const double ratio = 2.0 * j / (ratio_count - 1) - 1.0;
      const PairStatistics pairs(ratio * high, high, components, reach);
      const WienerSolver solver(pairs);
      for (int k = 0; k < samples_count; ++k) {
        const std::vector<double> filter = solver.weights(samples_at(k));
        filters_.insert(filters_.end(), filter.begin(), filter.end());
      }
    }
  }
}

void WienerTable::weights(const AxisWedge& wedge, double samples, float* out) const {
  const TurnedWedge turned = turned_wedge(bounded_wedge(wedge, float(max_shift)));
  const double ratio = turned.high > 0.0 ? std::clamp(turned.low / turned.high, -1.0, 1.0) : 0.0;
  const double bounded_samples = samples >= 1.0 ? std::min(samples, max_samples) : 1.0;
  const GridPlace at_shift(shift_position(turned.high), shift_count);
  const GridPlace at_ratio(0.5 * (ratio + 1.0) * (ratio_count - 1), ratio_count);
  const GridPlace at_samples(samples_position(bounded_samples), samples_count);
  std::fill(out, out + size_, 0.0f);
  for (int corner = 0; corner < 8; ++corner) {
    const int i = corner & 1, j = corner >> 1 & 1, k = corner >> 2;
    const float share = float(at_shift.of(i) * at_ratio.of(j) * at_samples.of(k));
    if (share == 0.0f) continue;
    const float* filter = entry(at_shift.first + i, at_ratio.first + j, at_samples.first + k);
    for (size_t n = 0; n < size_; ++n) out[n] += share * filter[n];
  }
  if (!turned.mirrored) return;
  const int row = 2 * reach + 1;
  for (int k = 1; k < components_; k += 2)
    for (int n = 0; n < row; ++n) out[k * row + n] = -out[k * row + n];
}

}  // namespace tessera
