#pragma once
/// Memo caches of shaded values, as graphics hardware would have them: which requests find their
/// value there and which have to be shaded. Only names are kept, for counting.

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/error.h"

namespace tessera {

/// A set of names with places: open addressing with linear probing, at most half full.
class NameTable {
 public:
  static constexpr uint32_t absent = 0xffffffffu;

  /// Room for `capacity` names before the table grows.
  explicit NameTable(size_t capacity)
      : slots_(std::bit_ceil(std::max(least_slots, 2 * capacity))) {}
  /// The place of `name`, or absent.
  uint32_t find(uint64_t name) const { return slots_[slot_of(name)].place; }
  /// `name` must be absent, and `place` another number than `absent`.
  void insert(uint64_t name, uint32_t place) {
    if (2 * (size_ + 1) > slots_.size()) grow();
    slots_[slot_of(name)] = {name, place};
    ++size_;
  }
  /// `name` must be there. The names behind it close the gap, so that nothing is left to slow
  /// later searches.
  void erase(uint64_t name) {
    const size_t mask = slots_.size() - 1;
    size_t gap = slot_of(name);
    for (size_t slot = (gap + 1) & mask; slots_[slot].place != absent; slot = (slot + 1) & mask) {
      // A name may move back to the gap unless its search starts behind it.
      const size_t from_home = (slot - home(slots_[slot].name)) & mask;
      if (from_home < ((slot - gap) & mask)) continue;
      slots_[gap] = slots_[slot];
      gap = slot;
    }
    slots_[gap].place = absent;
    --size_;
  }
  size_t size() const { return size_; }

 private:
  static constexpr size_t least_slots = 16;

  struct Slot {
    uint64_t name = 0;
    uint32_t place = absent;
  };
  /// Names need not be hashes: counters, and multiples of a power of two, are spread as well.
  size_t home(uint64_t name) const {
    name = (name ^ (name >> 32)) * 0x9e3779b97f4a7c15u;
    return size_t(name >> 32) & (slots_.size() - 1);
  }
  size_t slot_of(uint64_t name) const {
    size_t slot = home(name);
    while (slots_[slot].place != absent && slots_[slot].name != name)
      slot = (slot + 1) & (slots_.size() - 1);
    return slot;
  }
  void grow() {
    std::vector<Slot> old(2 * slots_.size());
    old.swap(slots_);
    for (const Slot& slot : old)
      if (slot.place != absent) slots_[slot_of(slot.name)] = slot;
  }

  std::vector<Slot> slots_;  // a power of two of them
  size_t size_ = 0;
};

/// A fully associative cache of a fixed number of entries in which the least recently used one is
/// replaced (the decoupling cache of Ragan-Kelley et al., "Decoupled Sampling for Graphics
/// Pipelines", 2011, section 3). A request takes constant time and allocates nothing.
class MemoCache {
 public:
  /// Throws Error unless 1 <= entries <= 2^30.
  explicit MemoCache(size_t entries) : capacity_(checked(entries)), places_(capacity_) {
    entries_.reserve(capacity_);
  }
  /// Asks for a value; true if it had to be shaded.
  bool request(uint64_t name) {
    const uint32_t found = places_.find(name);
    if (found != NameTable::absent) {
      if (found == newest_) return false;
      unlink(found);
      make_newest(found);
      return false;
    }
    if (entries_.size() < capacity_) {
      entries_.push_back({name, 0, 0});
      make_newest(uint32_t(entries_.size() - 1));
    } else {
      // The oldest gives its place, which in the ring is already next to the newest.
      newest_ = entries_[newest_].newer;
      places_.erase(entries_[newest_].name);
      entries_[newest_].name = name;
    }
    places_.insert(name, newest_);
    return true;
  }

 private:
  struct Entry {
    uint64_t name;
    uint32_t newer, older;  // places in entries_, in a ring
  };
  static size_t checked(size_t entries) {
    if (entries >= 1 && entries <= (size_t(1) << 30)) return entries;
    throw Error(
        fmt::format("a memo cache must have between 1 and 2^30 entries, found {}", entries));
  }
  void unlink(uint32_t place) {
    const Entry& entry = entries_[place];
    entries_[entry.newer].older = entry.older;
    entries_[entry.older].newer = entry.newer;
  }
  void make_newest(uint32_t place) {
    Entry& entry = entries_[place];
    if (newest_ == NameTable::absent) {
      entry.newer = entry.older = place;
    } else {
      // The ring closes: the newest has the oldest as its newer neighbour.
      const uint32_t oldest = entries_[newest_].newer;
      entry.older = newest_, entry.newer = oldest;
      entries_[newest_].newer = entries_[oldest].older = place;
    }
    newest_ = place;
  }

  size_t capacity_;
  NameTable places_;
  std::vector<Entry> entries_;
  uint32_t newest_ = NameTable::absent;
};

}  // namespace tessera
