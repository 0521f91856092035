#include "reconstruct/wiener_model.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "reconstruct/cholesky.h"
#include "reconstruct/legendre.h"
#include "reconstruct/quadrature.h"

namespace tessera {
namespace {

constexpr double length = wiener_pattern_length;

/// gamma integrated from 0 twice and three times, r >= 0.
struct GammaIntegrals {
  double second, third;
};
GammaIntegrals gamma_integrals(double r) {
  const double first = r + length * std::expm1(-r / length);
  const double second = 0.5 * r * r - length * first;
  return {length * second, length * (r * r * r / 6.0 - length * second)};
}

/// gamma averaged over the two places within pixels, and its integral from 0. The mean over the
/// difference of two uniform numbers is a second difference of the second integral; where gamma is
/// smooth that leaves one exponential. Even and odd.
struct PixelGamma {
  double value, integral;
};
PixelGamma pixel_gamma(double r) {
  static const double spread = 2.0 * std::cosh(1.0 / length) - 2.0;
  const double a = std::abs(r);
  if (a >= 1.0) {
    const double value = length - length * length * length * spread * std::exp(-a / length);
    return {value, std::copysign(length * a - length * value, r)};
  }
  const GammaIntegrals ahead = gamma_integrals(1.0 + a), here = gamma_integrals(a),
                       behind = gamma_integrals(1.0 - a);
  return {ahead.second - 2.0 * here.second + behind.second,
          std::copysign(ahead.third - 2.0 * here.third - behind.third, r)};
}

/// The mean of pixel_gamma over [a, b], in any order. Close together, the difference of integrals
/// would lose its digits; the middle errs by (b - a)^2 / 24 then.
double mean_gamma(double a, double b) {
  if (std::abs(b - a) < 1e-3) return pixel_gamma(0.5 * (a + b)).value;
  return (pixel_gamma(b).integral - pixel_gamma(a).integral) / (b - a);
}

/// Coefficients c[l] of P_j P_k = sum over l of c[l] P_l.
ProductCoefficients product_coefficients(int j, int k) {
  ProductCoefficients c{};
  std::array<double, max_product_degrees> p{};
  for (int l = 0; l <= j + k; ++l) {
    c[size_t(l)] = 0.5 * (2 * l + 1) * gauss_integral(-1.0, 1.0, 4, [&](double y) {
                     legendre(y, max_product_degrees, p.data());
                     return p[size_t(j)] * p[size_t(k)] * p[size_t(l)];
                   });
  }
  return c;
}

double sign_of(int k) { return k % 2 ? -1.0 : 1.0; }

}  // namespace

PairStatistics::PairStatistics(double low, double high, int components, int reach)
    : low_(low),
      high_(high),
      components_(components),
      reach_(reach),
      values_(size_t((2 * components - 1) * components * (2 * reach + 1))) {
  // gamma of a pixel bends where distances are whole pixels: panels that end there, for the largest
  // shift, keep errors below what large sample counts would show as indefinite matrices.
  const double farthest = std::max({std::abs(low), std::abs(high), 0.5});
  const int panels = int(std::ceil(2.0 * farthest));
  for (int i = 0; i < panels; ++i) {
    const double begin = i / farthest, half = 0.5 * (std::min(2.0, (i + 1) / farthest) - begin);
    for (size_t q = 0; q < gauss_points.size(); ++q)
      add(begin + half * (1.0 + gauss_points[q]), half * gauss_weights[q]);
  }
}

double PairStatistics::operator()(int a, int b, int distance) const {
  const int size = 2 * reach_ + 1;
  const double value = values_[size_t((a * components_ + b) * size + std::abs(distance))];
  return distance < 0 ? sign_of(a + b) * value : value;
}

/// Adds the pairs with y - y' = +-y_difference. The share of pairs with a difference u, weighted by
/// polynomials, is the integral of P_a(y) P_b(y - u) / 4; u -> -u multiplies it by (-1)^(a + b).
void PairStatistics::add(double y_difference, double weight) {
  const int degrees = 2 * components_ - 1;
  std::vector<double> share(size_t(degrees * components_));
  std::array<double, max_product_degrees> p{}, p_other{};
  const double middle = 0.5 * y_difference, half = 1.0 - middle;
  for (size_t q = 0; q < gauss_points.size(); ++q) {
    legendre(middle + half * gauss_points[q], degrees, p.data());
    legendre(-middle + half * gauss_points[q], components_, p_other.data());
    for (int a = 0; a < degrees; ++a)
      for (int b = 0; b < (a < components_ ? components_ : 1); ++b)
        share[size_t(a * components_ + b)] +=
            0.25 * weight * half * gauss_weights[q] * p[size_t(a)] * p_other[size_t(b)];
  }
  for (int distance = 0; distance <= 2 * reach_; ++distance) {
    const double ahead =
        mean_gamma(distance + low_ * y_difference, distance + high_ * y_difference);
    const double behind =
        mean_gamma(distance - low_ * y_difference, distance - high_ * y_difference);
    for (int a = 0; a < degrees; ++a)
      for (int b = 0; b < (a < components_ ? components_ : 1); ++b)
        at(a, b, distance) +=
            share[size_t(a * components_ + b)] * (ahead + sign_of(a + b) * behind);
  }
}

WienerSolver::WienerSolver(const PairStatistics& pairs) : pairs_(pairs) {
  for (int j = 0; j < pairs.components(); ++j)
    for (int k = 0; k < pairs.components(); ++k) products_.push_back(product_coefficients(j, k));
  for (int k = 0; k < pairs.components(); ++k)
    for (int dx = k % 2; dx <= pairs.reach(); ++dx) unknowns_.push_back({k, dx, sign_of(k)});
  const size_t size = unknowns_.size();
  signal_.resize(size * size);
  noise_.resize(size * size);
  for (size_t a = 0; a < size; ++a) {
    for (size_t b = 0; b <= a; ++b) {
      signal_[a * size + b] = folded_signal(unknowns_[a], unknowns_[b]);
      noise_[a * size + b] = folded_noise(unknowns_[a], unknowns_[b]);
    }
  }
}

/// Covariance of m_j at x and m_k at x_other, less t, for samples without number.
double WienerSolver::signal(int j, int x, int k, int x_other) const {
  double sum = -pairs_(j, k, x - x_other);
  if (k == 0) sum += pairs_(j, 0, x);
  if (j == 0) sum += pairs_(k, 0, x_other);
  if (j == 0 && k == 0) sum -= pairs_(0, 0, 0);
  return sum;
}

/// The mean of P_j P_k (f - t)^2 over single samples of the pixel at x.
double WienerSolver::one_sample(int j, int k, int x) const {
  const ProductCoefficients& c = products_[size_t(j * pairs_.components() + k)];
  double sum = j == k ? -pairs_(0, 0, 0) / (2 * k + 1) : 0.0;
  for (int l = 0; l <= j + k; ++l) sum += 2.0 * c[size_t(l)] * pairs_(l, 0, x);
  return sum;
}

double WienerSolver::folded_signal(const Unknown& a, const Unknown& b) const {
  double sum = signal(a.k, a.dx, b.k, b.dx);
  if (b.dx > 0) sum += b.parity * signal(a.k, a.dx, b.k, -b.dx);
  // The other half is the same, mirrored.
  return a.dx > 0 ? 2.0 * sum : sum;
}

double WienerSolver::folded_noise(const Unknown& a, const Unknown& b) const {
  if (a.dx != b.dx) return 0.0;
  const double sum = one_sample(a.k, b.k, a.dx) - signal(a.k, a.dx, b.k, a.dx);
  return a.dx > 0 ? 2.0 * sum : sum;
}

std::vector<double> WienerSolver::weights(double samples) const {
  const size_t size = unknowns_.size();
  std::vector<double> matrix(size * size), sums(size), x(size);
  for (size_t i = 0; i < matrix.size(); ++i) matrix[i] = signal_[i] + noise_[i] / samples;
  // Least error for a given sum of weights: matrix * x along the vector of sums.
  for (size_t a = 0; a < size; ++a) {
    matrix[a * size + a] *= 1.0 + 1e-9;
    sums[a] = unknowns_[a].k == 0 ? (unknowns_[a].dx > 0 ? 2.0 : 1.0) : 0.0;
  }
  solve_positive(matrix, sums, x);
  double sum = 0.0;
  for (size_t a = 0; a < size; ++a) sum += sums[a] * x[a];

  const int reach = pairs_.reach();
  std::vector<double> out(size_t(pairs_.components() * (2 * reach + 1)));
  for (size_t a = 0; a < size; ++a) {
    const Unknown& u = unknowns_[a];
    double* middle = &out[size_t(u.k * (2 * reach + 1) + reach)];
    middle[-u.dx] = u.parity * x[a] / sum;
    middle[u.dx] = x[a] / sum;
  }
  return out;
}

double WienerSolver::equivalent_pixels(const std::vector<double>& filter) const {
  const size_t row = size_t(2 * pairs_.reach() + 1);
  double noise = 0.0;
  for (size_t i = 0; i < filter.size(); ++i)
    noise += filter[i] * filter[i] / double(2 * (i / row) + 1);
  return 1.0 / noise;
}

}  // namespace tessera
