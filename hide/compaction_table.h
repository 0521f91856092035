#pragma once
/// Lane permutations that close the gaps in a vector.

#include <array>
#include <cstddef>
#include <cstdint>

namespace tessera {

/// table[mask][k]: the lane that comes k-th when the lanes whose bits are set in `mask` are moved
/// to the front. The lanes behind them do not matter.
template <size_t kLanes>
constexpr auto make_compaction_table() {
  std::array<std::array<int32_t, kLanes>, size_t(1) << kLanes> table{};
  for (size_t mask = 0; mask < table.size(); ++mask) {
    size_t k = 0;
    for (size_t lane = 0; lane < kLanes; ++lane)
      if (mask >> lane & 1) table[mask][k++] = int32_t(lane);
  }
  return table;
}

template <size_t kLanes>
alignas(64) inline constexpr auto compaction_table = make_compaction_table<kLanes>();

}  // namespace tessera
