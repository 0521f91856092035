#pragma once
/// Algebra on Bezier control points, for patches of any degree.

#include <array>
#include <vector>

#include <glm/glm.hpp>

namespace tessera {

/// Replaces `points` (one curve; element k at points[k * stride]) by the control points of its part
/// over [a, b], by two de Casteljau splits.
template <class Point>
void restrict_bezier(Point* points, int degree, int stride, double a, double b) {
  using Scalar = typename Point::value_type;
  const auto at = [&](int k) -> Point& { return points[k * stride]; };
  if (b < 1.0) {
    for (int r = 1; r <= degree; ++r) {
      for (int k = degree; k >= r; --k) {
        at(k) = at(k - 1) * Scalar(1.0 - b) + at(k) * Scalar(b);
      }
    }
  }
  if (a > 0.0) {
    const double s = a / b;
    for (int r = 1; r <= degree; ++r) {
      for (int k = 0; k <= degree - r; ++k) {
        at(k) = at(k) * Scalar(1.0 - s) + at(k + 1) * Scalar(s);
      }
    }
  }
}

/// Bezier points from the points of a cubic in basis B (rows weigh t^3 t^2 t 1, row-major):
/// the matrix C with bezier_i = sum_j C[4 i + j] p_j.
std::array<double, 16> bezier_from_basis(const std::array<double, 16>& basis);
/// bezier_from_basis of the uniform cubic B-spline.
const std::array<double, 16>& bezier_from_bspline();

}  // namespace tessera
