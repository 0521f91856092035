#include "reconstruct/cholesky.h"

#include <algorithm>
#include <cmath>

namespace tessera {
namespace {

/// In four partial sums, so that one addition need not wait for the last.
double dot(const double* a, const double* b, size_t count) {
  double sums[4] = {};
  size_t i = 0;
  for (; i + 4 <= count; i += 4)
    for (size_t lane = 0; lane < 4; ++lane) sums[lane] += a[i + lane] * b[i + lane];
  double rest = 0.0;
  for (; i < count; ++i) rest += a[i] * b[i];
  return (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest;
}

}  // namespace

void solve_positive(std::vector<double>& matrix, std::span<const double> b, std::span<double> x) {
  const size_t size = b.size();
  for (size_t i = 0; i < size; ++i) {
    double* row = &matrix[i * size];
    for (size_t j = 0; j < i; ++j) {
      const double* other = &matrix[j * size];
      row[j] = (row[j] - dot(row, other, j)) / other[j];
    }
    const double pivot = row[i] - dot(row, row, i);
    row[i] = std::sqrt(std::max(pivot, 1e-14 * std::abs(row[i]) + 1e-300));
  }
  for (size_t i = 0; i < size; ++i)
    x[i] = (b[i] - dot(&matrix[i * size], x.data(), i)) / matrix[i * size + i];
  for (size_t i = size; i-- > 0;) {
    double sum = x[i];
    for (size_t j = i + 1; j < size; ++j) sum -= matrix[j * size + i] * x[j];
    x[i] = sum / matrix[i * size + i];
  }
}

}  // namespace tessera
