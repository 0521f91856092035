#pragma once
/// Linear systems.

#include <cstddef>
#include <span>
#include <vector>

namespace tessera {

/// Solves matrix * x = b for a symmetric positive definite matrix [row][column], in place
/// (Cholesky: the matrix becomes the factor). Pivots that rounding made negative are taken as tiny.
void solve_positive(std::vector<double>& matrix, std::span<const double> b, std::span<double> x);

}  // namespace tessera
