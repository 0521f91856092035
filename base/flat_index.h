#pragma once
/// A map from 64-bit names to 0, 1, 2, ... in the order in which they came.

#include <cstdint>
#include <utility>
#include <vector>

namespace tessera {

/// Open addressing with linear probing. Names should be well mixed in their low bits.
class FlatIndex {
 public:
  FlatIndex() = default;
  /// Grows once at most if no more than `expected` names come.
  explicit FlatIndex(size_t expected) { rebuild(expected); }

  size_t size() const { return names_.size(); }
  uint64_t name(uint32_t index) const { return names_[index]; }

  /// The number of `name`, and whether it is new.
  std::pair<uint32_t, bool> insert(uint64_t name) {
    if (2 * (names_.size() + 1) > slots_.size()) rebuild(2 * names_.size() + 8);
    size_t at = name & (slots_.size() - 1);
    while (slots_[at] != empty) {
      if (names_[slots_[at]] == name) return {slots_[at], false};
      at = (at + 1) & (slots_.size() - 1);
    }
    slots_[at] = uint32_t(names_.size());
    names_.push_back(name);
    return {slots_[at], true};
  }

 private:
  static constexpr uint32_t empty = ~0u;

  void rebuild(size_t expected) {
    size_t size = 16;
    while (size < 2 * expected) size *= 2;
    slots_.assign(size, empty);
    for (size_t i = 0; i < names_.size(); ++i) {
      size_t at = names_[i] & (size - 1);
      while (slots_[at] != empty) at = (at + 1) & (size - 1);
      slots_[at] = uint32_t(i);
    }
  }

  std::vector<uint32_t> slots_;  ///< a power of two, at most half full
  std::vector<uint64_t> names_;
};

}  // namespace tessera
