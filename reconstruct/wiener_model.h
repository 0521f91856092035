#pragma once
/// Statistics of what samples near a pixel see, for the best linear filter of them.
///
/// Along one image axis a pixel at x has samples f(x + xi_j, y_j), xi uniform over the pixel and y
/// over [-1, 1], of f(x, y) = g(x + d y). Patterns g are random with correlations exp(-r / length)
/// (edges at random places); the shift d is uniform in the wedge. Pixels keep moments
/// m_k(x) = mean of P_k(y_j) f_j, and what is wanted is t, the mean of f over pixel 0 and over y.
///
/// Sums of weights are 1, so that everything is a matter of differences f - t, whose statistics
/// follow from the mean square of half a difference, gamma(r) = length (1 - exp(-r / length)):
/// cov(f(a) - t, f(b) - t) = -gamma(a - b) + mean gamma(a - t) + mean gamma(b - t) - mean gamma(t -
/// t).

#include <array>
#include <cstddef>
#include <vector>

namespace tessera {

inline constexpr int max_wiener_components = 7;

/// Pixels: the length over which patterns correlate.
inline constexpr double wiener_pattern_length = 32.0;

/// Means of gamma over pairs of samples of two pixels, weighted by P_a of one sample's y and P_b of
/// the other's.
class PairStatistics {
 public:
  /// `low`, `high`: pixels, of the wedge. `components`: number of moments. `reach`: pixels.
  PairStatistics(double low, double high, int components, int reach);

  /// E[P_a(y) P_b(y') gamma(distance + d (y - y') + xi - xi')], |distance| <= 2 * reach, for a, b <
  /// components or b = 0, a <= 2 * (components - 1).
  double operator()(int a, int b, int distance) const;

  int components() const { return components_; }
  int reach() const { return reach_; }

 private:
  void add(double y_difference, double weight);
  double& at(int a, int b, int distance) {
    return values_[size_t((a * components_ + b) * (2 * reach_ + 1) + distance)];
  }

  double low_, high_;
  int components_, reach_;
  std::vector<double> values_;  ///< [a][b][distance >= 0]
};

/// Degrees of products of two of the polynomials.
inline constexpr int max_product_degrees = 2 * max_wiener_components - 1;
/// c[l] of P_j P_k = sum over l of c[l] P_l.
using ProductCoefficients = std::array<double, max_product_degrees>;

/// The weights of the best filter: [k * (2 * reach + 1) + reach + dx]. `samples` a pixel > 0. Those
/// of P_0 sum to 1, and A_k(-dx) = (-1)^k A_k(dx).
class WienerSolver {
 public:
  explicit WienerSolver(const PairStatistics& pairs);
  std::vector<double> weights(double samples) const;

  /// Among how many pixels' worth of samples a filter shares noise: 1 / sum of A_k^2 / (2 k + 1),
  /// as P_k has the mean square 1 / (2 k + 1).
  double equivalent_pixels(const std::vector<double>& filter) const;

 private:
  /// One free number of the filter: the weight of P_k at dx, and by symmetry at -dx.
  struct Unknown {
    int k, dx;
    double parity;  ///< (-1)^k
  };
  double signal(int j, int x, int k, int x_other) const;
  double one_sample(int j, int k, int x) const;
  double folded_signal(const Unknown& a, const Unknown& b) const;
  double folded_noise(const Unknown& a, const Unknown& b) const;

  const PairStatistics& pairs_;
  std::vector<Unknown> unknowns_;
  std::vector<ProductCoefficients> products_;  ///< [j][k]
  std::vector<double> signal_, noise_;  ///< [unknown][unknown], lower half; noise: of one sample
};

}  // namespace tessera
