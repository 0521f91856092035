#include "cameras/spectrum.h"

#include "base/error.h"

namespace tessera {

void check_energy_share(double energy_share) {
  if (!(energy_share > 0.0 && energy_share <= 0.9999))
    throw Error(fmt::format("band limit: energy share {} is outside (0, 0.9999]", energy_share));
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

}  // namespace tessera
