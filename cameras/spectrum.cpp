#include "cameras/spectrum.h"

#include <cmath>
#include <numbers>

#include "base/error.h"

namespace tessera {
namespace {

/// Integral of the power spectrum over frequencies within f. The disc of radius f has the transform
/// f J1(2 pi f s) / s, so by Parseval it is 2 pi f * integral of overlap(s) J1(2 pi f s) ds, and by
/// parts overlap(0) + integral of overlap'(s) J0(2 pi f s) ds, which does not magnify errors of the
/// quadrature by f.
double energy_within(double f, std::span<const double> overlap, double reach) {
  const size_t last = overlap.size() - 1;
  const double step = reach / double(last);
  // At least 64 midpoints in each period of the Bessel function.
  const int per_interval = 4 + int(64.0 * f * step);
  double energy = overlap[0];
  for (size_t i = 0; i < last; ++i) {
    double mean_j0 = 0.0;
    for (int k = 0; k < per_interval; ++k) {
      const double distance = step * (double(i) + (k + 0.5) / per_interval);
      mean_j0 += ::j0(2.0 * std::numbers::pi * f * distance) / per_interval;
    }
    energy += (overlap[i + 1] - overlap[i]) * mean_j0;
  }
  return energy;
}

}  // namespace

void check_energy_share(double energy_share) {
  if (!(energy_share > 0.0 && energy_share <= most_energy_share))
    throw Error(fmt::format("band limit: energy share {} is outside (0, {}]", energy_share,
                            most_energy_share));
}

double frequency_holding(double energy_share, double total_energy,
                         const std::function<double(double)>& power) {
  check_energy_share(energy_share);
  // Power of a function of support 2.2 oscillates with a period of at least 1/2.2: each period gets
  // at least 14 Simpson panels.
  constexpr double step = 1.0 / 32.0;
  constexpr double highest = 4096.0;
  const double wanted = energy_share * total_energy;
  double sum = 0.0, at_start = power(0.0);
  for (int panel = 0; panel * step < highest; ++panel) {
    const double start = panel * step;
    const double at_middle = power(start + 0.5 * step), at_end = power(start + step);
    // Integral of the parabola through the three values over the first fraction x of the panel.
    const auto energy = [&](double x) {
      const double slope = 4.0 * at_middle - 3.0 * at_start - at_end;
      const double curve = 2.0 * (at_start - 2.0 * at_middle + at_end);
      return step * x * (at_start + x * (slope / 2.0 + x * curve / 3.0));
    };
    if (sum + energy(1.0) >= wanted) {
      double low = 0.0, high = 1.0;
      for (int i = 0; i < 40; ++i) {
        const double x = 0.5 * (low + high);
        (sum + energy(x) < wanted ? low : high) = x;
      }
      return start + step * low;
    }
    sum += energy(1.0);
    at_start = at_end;
  }
  return highest;
}

double radius_holding(double energy_share, std::span<const double> overlap, double reach) {
  check_energy_share(energy_share);
  const double wanted = energy_share * overlap[0];
  double low = 0.0, high = 2.0 / reach;
  while (energy_within(high, overlap, reach) < wanted) low = high, high *= 2.0;
  for (int i = 0; i < 30; ++i) {
    const double middle = 0.5 * (low + high);
    (energy_within(middle, overlap, reach) < wanted ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace tessera
