#include "dice/bezier.h"

#include <cmath>

namespace tessera {

std::array<double, 16> bezier_from_basis(const std::array<double, 16>& basis) {
  // Inverse of the Bezier basis matrix: the power form's Bezier points.
  constexpr double third = 1.0 / 3.0;
  constexpr double inverse[16] = {0, 0, 0, 1, 0, 0, third, 1, 0, third, 2 * third, 1, 1, 1, 1, 1};
  std::array<double, 16> product{};
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      double sum = 0;
      for (int k = 0; k < 4; ++k) sum += inverse[4 * i + k] * basis[size_t(4 * k + j)];
      // Whole numbers are meant exactly: the Bezier basis itself must give the identity, so that
      // patches keep their corner points bit for bit.
      const double whole = std::round(sum);
      product[size_t(4 * i + j)] = std::abs(sum - whole) < 1e-14 ? whole : sum;
    }
  }
  return product;
}

const std::array<double, 16>& bezier_from_bspline() {
  static constexpr double s = 1.0 / 6.0;
  static constexpr std::array<double, 16> matrix{s, 4 * s, s,     0, 0, 4 * s, 2 * s, 0,
                                                 0, 2 * s, 4 * s, 0, 0, s,     4 * s, s};
  return matrix;
}

}  // namespace tessera
