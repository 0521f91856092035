#pragma once
/// The Sobol sequence in five dimensions, and Owen's nested uniform scrambling by hashing.
///
/// A coordinate is kept with its binary digits reversed: bit 0 is the most significant digit after
/// the binary point. Scrambling a digit depends on the digits above it, that is, on the bits below
/// it, which is how carries travel in an integer multiplication; see B. Burley, "Practical
/// Hash-based Owen Scrambling", JCGT 9(4), 2020.

#include <array>
#include <cstddef>
#include <cstdint>

namespace tessera {

inline constexpr int sobol_dimensions = 5;
inline constexpr int sobol_index_bits = 17;  ///< enough for indices below 2^17

/// Columns of the generator matrices: coordinate digits (reversed) that bit `i` of the index flips.
using SobolMatrix = std::array<uint32_t, sobol_index_bits>;
const std::array<SobolMatrix, sobol_dimensions>& sobol_matrices();

/// Reversed digits of coordinate `dimension` of point `index`.
inline uint32_t sobol_reversed(int dimension, uint32_t index) {
  const SobolMatrix& matrix = sobol_matrices()[size_t(dimension)];
  uint32_t digits = 0;
  for (int i = 0; index != 0; ++i, index >>= 1)
    if (index & 1) digits ^= matrix[size_t(i)];
  return digits;
}

/// Nested uniform scramble of reversed digits: bit k of the result is bit k of `x`, flipped by a
/// hash of the bits below k and the seed. Multiplying by even numbers before the xor, and by odd
/// ones otherwise, keeps that triangular form; the constants are N. Vegdahl's.
constexpr uint32_t owen_scramble_reversed(uint32_t x, uint32_t seed) {
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16) | 1u;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return x;
}

}  // namespace tessera
