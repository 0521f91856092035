#pragma once
/// Integer hashes for seeds and stable identities.

#include <cstdint>

namespace tessera {

/// A full-avalanche 32-bit mix (the "lowbias32" constants found by exhaustive search by C. Wellons).
constexpr uint32_t mix32(uint32_t x) {
  x ^= x >> 16;
  x *= 0x7feb352du;
  x ^= x >> 15;
  x *= 0x846ca68bu;
  x ^= x >> 16;
  return x;
}

/// Folds `value` into `seed`.
constexpr uint32_t hash_combine(uint32_t seed, uint32_t value) {
  return mix32(seed ^ (value + 0x9e3779b9u + (seed << 6) + (seed >> 2)));
}

}  // namespace tessera
