#pragma once
/// Legendre polynomials, orthogonal over [-1, 1]: the mean of P_j P_k is 1 / (2 k + 1) for j = k.

namespace tessera {

/// Writes P_0(y) .. P_{count-1}(y), by Bonnet's recursion.
template <class Real>
void legendre(Real y, int count, Real* out) {
  if (count > 0) out[0] = Real(1);
  if (count > 1) out[1] = y;
  for (int k = 2; k < count; ++k)
    out[k] = (Real(2 * k - 1) * y * out[k - 1] - Real(k - 1) * out[k - 2]) / Real(k);
}

}  // namespace tessera
