#pragma once
/// Memo caches of shaded values, as graphics hardware would have them: which requests find their
/// value there and which have to be shaded. Only names are kept, for counting.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tessera {

/// A set of names with places: open addressing with linear probing, at most half full.
class NameTable {
 public:
  static constexpr uint32_t absent = 0xffffffffu;

  /// Room for `capacity` names before the table grows.
  explicit NameTable(size_t capacity);
  /// The place of `name`, or absent.
  uint32_t find(uint64_t name) const;
  /// `name` must be absent, and `place` another number than `absent`.
  void insert(uint64_t name, uint32_t place);
  /// `name` must be there. The names behind it close the gap, so that nothing is left to slow
  /// later searches.
  void erase(uint64_t name);
  size_t size() const { return size_; }

 private:
  struct Slot {
    uint64_t name = 0;
    uint32_t place = absent;
  };
  size_t home(uint64_t name) const;
  size_t slot_of(uint64_t name) const;
  void grow();

  std::vector<Slot> slots_;  // a power of two of them
  size_t size_ = 0;
};

/// A fully associative cache of a fixed number of entries in which the least recently used one is
/// replaced (the decoupling cache of Ragan-Kelley et al., "Decoupled Sampling for Graphics
/// Pipelines", 2011, section 3). A request takes constant time and allocates nothing.
class MemoCache {
 public:
  /// Throws Error unless 1 <= entries <= 2^30.
  explicit MemoCache(size_t entries);
  /// Asks for a value; true if it had to be shaded.
  bool request(uint64_t name);

 private:
  struct Entry {
    uint64_t name;
    uint32_t newer, older;  // places in entries_, in a ring
  };
  void unlink(uint32_t place);
  void make_newest(uint32_t place);

  size_t capacity_;
  NameTable places_;
  std::vector<Entry> entries_;
  uint32_t newest_ = NameTable::absent;
};

/// A cache that forgets nothing.
class UnboundedMemo {
 public:
  UnboundedMemo();
  /// Asks for a value; true if it had to be shaded.
  bool request(uint64_t name);

 private:
  void grow();

  std::vector<uint64_t> slots_;  // names, 0 where there is none; a power of two of them
  size_t size_ = 0;
  bool has_zero_ = false;
};

}  // namespace tessera
