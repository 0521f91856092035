#include "cameras/spectrum.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/error.h"

namespace tessera {
namespace {

/// A distance and how much of the autocorrelation's change belongs to it.
struct WeightedDistance {
  double distance, weight;
};

/// Places in (-1, 1) through which polynomials of degree 5 stand in for the Bessel function over a
/// block half a radian long, where they miss it by 1e-8 (Chebyshev's places).
constexpr size_t block_places = 6;
constexpr double longest_block_radians = 0.5;
using PlaceValues = std::array<double, block_places>;

PlaceValues chebyshev_places() {
  PlaceValues places;
  for (size_t j = 0; j < block_places; ++j)
    places[j] = -std::cos(std::numbers::pi * (double(j) + 0.5) / double(block_places));
  return places;
}

/// 1 / the product of the distances of each place to the others.
PlaceValues lagrange_scales(const PlaceValues& places) {
  PlaceValues scales;
  for (size_t j = 0; j < block_places; ++j) {
    double product = 1.0;
    for (size_t i = 0; i < block_places; ++i)
      if (i != j) product *= places[j] - places[i];
    scales[j] = 1.0 / product;
  }
  return scales;
}

/// Sums, for functions of distance, the integral of overlap'(s) times the function as weights of
/// few distances: the same for every frequency up to one, so that they are made once for all of a
/// search.
class ChangeSum {
 public:
  /// `overlap` as radius_holding() takes it. Frequencies up to `highest`, cycles per unit.
  ChangeSum(std::span<const double> overlap, double reach, double highest)
      : places_(chebyshev_places()), scales_(lagrange_scales(places_)) {
    const size_t intervals = overlap.size() - 1;
    const double step = reach / double(intervals);
    const double radians = 2.0 * std::numbers::pi * highest * step;  // an interval's
    // Blocks of whole intervals, or whole blocks in an interval.
    const size_t blocked = size_t(std::clamp(longest_block_radians / radians, 1.0, 64.0));
    const size_t parts = size_t(std::max(1.0, std::ceil(radians / longest_block_radians)));
    for (size_t i = 0; i < intervals; i += blocked) {
      const size_t end = std::min(i + blocked, intervals);
      for (size_t part = 0; part < parts; ++part)
        add_block(overlap.subspan(i, end - i + 1), double(i), double(part) / double(parts),
                  1.0 / double(parts), step);
    }
  }

  double of_bessel(double frequency) const {
    double sum = 0.0;
    for (const WeightedDistance& d : distances_)
      sum += d.weight * ::j0(2.0 * std::numbers::pi * frequency * d.distance);
    return sum;
  }

 private:
  /// The intervals of `overlap`, the first of which begins at `first` steps; of each the share
  /// `share` from the fraction `begin` on, which is all but where a block is less than an interval.
  void add_block(std::span<const double> overlap, double first, double begin, double share,
                 double step) {
    const double length = double(overlap.size() - 2) + share;
    PlaceValues weights{};
    // Three Gauss points an interval integrate degree 5 exactly.
    constexpr double gauss_places[] = {-0.7745966692414834, 0.0, 0.7745966692414834};
    constexpr double gauss_weights[] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
    for (size_t i = 0; i + 1 < overlap.size(); ++i) {
      const double change = (overlap[i + 1] - overlap[i]) * share;
      for (size_t g = 0; g < 3; ++g) {
        const double at = double(i) + 0.5 * share * (1.0 + gauss_places[g]);
        add_polynomials(2.0 * at / length - 1.0, change * gauss_weights[g], weights);
      }
    }
    for (size_t j = 0; j < block_places; ++j)
      distances_.push_back(
          {step * (first + begin + 0.5 * length * (1.0 + places_[j])), weights[j]});
  }

  /// weights[j] += weight * (the polynomial that is 1 at place j and 0 at the others)(t).
  void add_polynomials(double t, double weight, PlaceValues& weights) const {
    PlaceValues below;  // products of the distances to the places before j
    double product = weight;
    for (size_t j = 0; j < block_places; ++j) below[j] = product, product *= t - places_[j];
    double above = 1.0;
    for (size_t j = block_places; j-- > 0;) {
      weights[j] += below[j] * above * scales_[j];
      above *= t - places_[j];
    }
  }

  PlaceValues places_, scales_;
  std::vector<WeightedDistance> distances_;
};

/// Where a rising function passes 0 within [low, high], from its values there, one below 0 and one
/// not: by the rule of false position, with the value of an end that stays halved (the Illinois
/// rule), to the last digits.
template <class Function>
double rising_root(double low, double at_low, double high, double at_high,
                   const Function& function) {
  int kept = 0;  // the end that the last step left where it was: -1 low, 1 high
  for (int i = 0; i < 60 && high - low > 1e-12 * high; ++i) {
    const double middle = high - at_high * (high - low) / (at_high - at_low);
    const double value = function(middle);
    if (std::abs(value) < 1e-15) return middle;
    if (value < 0.0) {
      low = middle, at_low = value;
      if (kept == 1) at_high *= 0.5;
      kept = 1;
    } else {
      high = middle, at_high = value;
      if (kept == -1) at_low *= 0.5;
      kept = -1;
    }
  }
  return 0.5 * (low + high);
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

/// The disc of radius f has the transform f J1(2 pi f s) / s, so by Parseval the energy within is
/// 2 pi f * integral of overlap(s) J1(2 pi f s) ds, and by parts overlap(0) + integral of
/// overlap'(s) J0(2 pi f s) ds, which does not magnify errors of the quadrature by f.
double radius_holding(double energy_share, std::span<const double> overlap, double reach) {
  check_energy_share(energy_share);
  const double missing = 1.0 - energy_share;
  double low = 0.0, at_low = -energy_share, high = 2.0 / reach;
  for (;; high *= 2.0) {
    const ChangeSum changes(overlap, reach, high);
    const auto excess = [&](double f) { return missing + changes.of_bessel(f) / overlap[0]; };
    const double at_high = excess(high);
    if (at_high >= 0.0) return rising_root(low, at_low, high, at_high, excess);
    low = high, at_low = at_high;
  }
}

}  // namespace tessera
