#pragma once
/// How well sums of Gaussians fit the double wedge of frequencies that a light's shadows fill
/// (L. Wu et al., "Multiple axis-aligned filters for rendering of combined distribution effects",
/// EGSR 2017, section 5). Frequencies in units of the band W.

#include <vector>

namespace tessera {

/// y frequencies -1 to 1, x frequencies between Omega_y / s_max and Omega_y / s_min; 0 < s_min <
/// s_max.
struct DoubleWedge {
  double s_min, s_max;
  double area() const { return 1.0 / s_min - 1.0 / s_max; }
};

/// A Gaussian of peak `weight` with the centre (x, y), sheared: its axis along y runs in the
/// direction (shear, 1).
struct SpectrumGaussian {
  double weight, x, y, x_deviation, y_deviation, shear = 0;
};

std::vector<SpectrumGaussian> aaf_spectrum(const DoubleWedge& wedge);  ///< equation 2
/// Equation 4. The half-width of the tight parallelogram is W (1 / s_min - 1 / s_max) / 2, half of
/// what is printed.
std::vector<SpectrumGaussian> fsf_spectrum(const DoubleWedge& wedge);
/// Equations 6 to 9 with weights of 1. `components`: odd.
std::vector<SpectrumGaussian> maaf_spectrum(const DoubleWedge& wedge, int components);

struct WedgeFit {
  double coverage;  ///< the share of the filter that lies in the wedge, equation 15
  double accuracy;  ///< 1 - its RMS difference from 1 in the wedge, equation 14
};
/// By quadrature.
WedgeFit gaussian_fit(const DoubleWedge& wedge, const std::vector<SpectrumGaussian>& filter);

/// Coverage where boxes and parallelograms stand in for the Gaussians: 1 component is AAF. All
/// cover the whole wedge: accuracy 1.
double box_coverage(const DoubleWedge& wedge, int components);

}  // namespace tessera
