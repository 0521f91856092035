#pragma once
/// Integrals of smooth functions.

#include <array>
#include <cstddef>

namespace tessera {

/// Gauss-Legendre quadrature with 8 points: exact for polynomials up to degree 15.
inline constexpr std::array<double, 8> gauss_points = {
    -0.96028985649753623, -0.79666647741362674, -0.52553240991632899, -0.18343464249564980,
    0.18343464249564980,  0.52553240991632899,  0.79666647741362674,  0.96028985649753623};
inline constexpr std::array<double, 8> gauss_weights = {
    0.10122853629037626, 0.22238103445337447, 0.31370664587788729, 0.36268378337836198,
    0.36268378337836198, 0.31370664587788729, 0.22238103445337447, 0.10122853629037626};

/// The integral of `f` over [low, high].
template <class Function>
double gauss_integral(double low, double high, const Function& f) {
  const double middle = 0.5 * (low + high), half = 0.5 * (high - low);
  double sum = 0.0;
  for (size_t i = 0; i < gauss_points.size(); ++i)
    sum += gauss_weights[i] * f(middle + half * gauss_points[i]);
  return half * sum;
}

/// The same, in `panels` equal pieces.
template <class Function>
double gauss_integral(double low, double high, int panels, const Function& f) {
  double sum = 0.0;
  for (int i = 0; i < panels; ++i)
    sum +=
        gauss_integral(low + (high - low) * i / panels, low + (high - low) * (i + 1) / panels, f);
  return sum;
}

}  // namespace tessera
