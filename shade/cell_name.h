#pragma once
/// Names of shading cells: 64-bit hashes, so few that two of one frame never meet in practice.

#include <cstdint>

#include "dice/grid.h"

namespace tessera {

/// A bijection of 64-bit words that leaves no pattern: the finaliser of SplitMix64 (G. Steele,
/// D. Lea, C. Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014).
constexpr uint64_t scrambled(uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

constexpr uint64_t grid_name(const GridId& id) {
  return scrambled(scrambled(uint64_t(id.surface) << 32 | id.face) + id.path);
}

/// Of cell (i, j) of whatever `owner` names; equal arguments, equal names.
constexpr uint64_t cell_name(uint64_t owner, uint64_t i, uint64_t j) {
  return scrambled(scrambled(owner + 0x9e3779b97f4a7c15u * i) + j);
}

}  // namespace tessera
