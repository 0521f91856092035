#pragma once
/// Where the energy of a spectrum lies: the numerical part of the profiles' band limits.

#include <functional>
#include <span>

namespace tessera {

/// Smallest frequency below which `energy_share` of `total_energy` lies, where `power(f)` is the
/// energy per unit frequency, already summed over directions (2 |P|^2 in one dimension,
/// 2 pi f |P|^2 for a radial profile in two). Frequencies in cycles per unit; `power` may not vary
/// faster than the spectrum of a function of support 2.2, and must hold `total_energy` in all.
/// Integrates by Simpson's rule upwards from 0. Throws Error unless energy_share is in
/// (0, 0.9999]: sharp edges spread the last share over frequencies without end.
double frequency_holding(double energy_share, double total_energy,
                         const std::function<double(double)>& power);

/// Radius within which `energy_share` of the power spectrum of a function of two dimensions lies,
/// in cycles per unit, from its autocorrelation: `overlap[i]` is the integral of f(p) f(p + s) dp
/// averaged over the directions of s, for |s| = reach * i / (overlap.size() - 1). It must be 0
/// beyond `reach`. Serves functions with straight edges, whose spectra have spikes, ever thinner
/// with frequency, where the autocorrelation is smooth. Throws Error as frequency_holding() does.
double radius_holding(double energy_share, std::span<const double> overlap, double reach);

/// No band limit holds more: see frequency_holding().
inline constexpr double most_energy_share = 0.9999;

/// Throws Error unless `energy_share` is in (0, most_energy_share].
void check_energy_share(double energy_share);

}  // namespace tessera
