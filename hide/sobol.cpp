#include "hide/sobol.h"

namespace tessera {
namespace {

/// A primitive polynomial over GF(2) of degree `degree` with inner coefficients `inner`, and the
/// first direction integers: dimensions 2 to 5 of S. Joe and F. Kuo, "Constructing Sobol sequences
/// with better two-dimensional projections", SIAM J. Sci. Comput. 30, 2008 (new-joe-kuo-6).
struct Direction {
  int degree;
  uint32_t inner;
  std::array<uint32_t, 3> m;
};
constexpr Direction directions[] = {
    {1, 0, {1, 0, 0}}, {2, 1, {1, 3, 0}}, {3, 1, {1, 3, 1}}, {3, 2, {1, 1, 1}}};

/// Direction numbers by the recurrence of Bratley and Fox, "Algorithm 659", ACM TOMS 14, 1988.
constexpr SobolMatrix make_matrix(const Direction& d) {
  std::array<uint32_t, sobol_index_bits> v{};
  for (int i = 0; i < sobol_index_bits; ++i) {
    if (i < d.degree) {
      v[size_t(i)] = d.m[size_t(i)] << (31 - i);
      continue;
    }
    uint32_t value = v[size_t(i - d.degree)] ^ (v[size_t(i - d.degree)] >> d.degree);
    for (int k = 1; k < d.degree; ++k)
      if (d.inner >> (d.degree - 1 - k) & 1u) value ^= v[size_t(i - k)];
    v[size_t(i)] = value;
  }
  SobolMatrix reversed{};
  for (size_t i = 0; i < reversed.size(); ++i) reversed[i] = reverse_bits(v[i]);
  return reversed;
}

constexpr std::array<SobolMatrix, sobol_dimensions> make_matrices() {
  std::array<SobolMatrix, sobol_dimensions> all{};
  // The first dimension is van der Corput's: reversed digits are the index itself.
  for (int i = 0; i < sobol_index_bits; ++i) all[0][size_t(i)] = 1u << i;
  for (size_t k = 1; k < all.size(); ++k) all[k] = make_matrix(directions[k - 1]);
  return all;
}

constexpr auto matrices = make_matrices();

}  // namespace

const std::array<SobolMatrix, sobol_dimensions>& sobol_matrices() { return matrices; }

}  // namespace tessera
