#pragma once
/// The Sobol sequence in five dimensions, and Owen's nested uniform scrambling by hashing.
///
/// A coordinate is kept with its binary digits reversed: bit 0 is the most significant digit after
/// the binary point. Scrambling a digit depends on the digits above it, that is, on the bits below
/// it, which is how carries travel in an integer multiplication; see B. Burley, "Practical
/// Hash-based Owen Scrambling", JCGT 9(4), 2020.

#include <array>
#include <bit>
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

constexpr uint32_t reverse_bits(uint32_t x) {
  x = (x >> 1 & 0x55555555u) | (x & 0x55555555u) << 1;
  x = (x >> 2 & 0x33333333u) | (x & 0x33333333u) << 2;
  x = (x >> 4 & 0x0f0f0f0fu) | (x & 0x0f0f0f0fu) << 4;
  x = (x >> 8 & 0x00ff00ffu) | (x & 0x00ff00ffu) << 8;
  return x >> 16 | x << 16;
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

/// A permutation of [0, 2^bits) that maps aligned blocks of a power of two to such blocks: nested
/// uniform scrambling of the index, whose own digits are reversed for that.
constexpr uint32_t shuffled_index(uint32_t index, int bits, uint32_t seed) {
  if (bits == 0) return 0;
  const uint32_t reversed = reverse_bits(index) >> (32 - bits);
  return reverse_bits(owen_scramble_reversed(reversed, seed)) >> (32 - bits);
}

/// A permutation of [0, count): shuffled_index() over the next power of two, applied again as long
/// as it leaves the range.
constexpr uint32_t permuted_index(uint32_t index, uint32_t count, uint32_t seed) {
  const int bits = std::bit_width(count - 1);
  do index = shuffled_index(index, bits, seed);
  while (index >= count);
  return index;
}

}  // namespace tessera
