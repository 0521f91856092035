#include "shade/memo_cache.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "base/error.h"

namespace tessera {
namespace {

constexpr size_t least_slots = 16;

/// Names need not be hashes: counters, and multiples of a power of two, are spread as well.
size_t home_of(uint64_t name, size_t slots) {
  name = (name ^ (name >> 32)) * 0x9e3779b97f4a7c15u;
  return size_t(name >> 32) & (slots - 1);
}

size_t checked_capacity(size_t entries) {
  if (entries < 1 || entries > (size_t(1) << 30))
    throw Error(
        fmt::format("a memo cache must have between 1 and 2^30 entries, found {}", entries));
  return entries;
}

}  // namespace

NameTable::NameTable(size_t capacity)
    : slots_(std::bit_ceil(std::max(least_slots, 2 * capacity))) {}

size_t NameTable::home(uint64_t name) const { return home_of(name, slots_.size()); }

size_t NameTable::slot_of(uint64_t name) const {
  size_t slot = home(name);
  while (slots_[slot].place != absent && slots_[slot].name != name)
    slot = (slot + 1) & (slots_.size() - 1);
  return slot;
}

uint32_t NameTable::find(uint64_t name) const { return slots_[slot_of(name)].place; }

void NameTable::insert(uint64_t name, uint32_t place) {
  if (2 * (size_ + 1) > slots_.size()) grow();
  slots_[slot_of(name)] = {name, place};
  ++size_;
}

void NameTable::erase(uint64_t name) {
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

void NameTable::grow() {
  std::vector<Slot> old(2 * slots_.size());
  old.swap(slots_);
  for (const Slot& slot : old)
    if (slot.place != absent) slots_[slot_of(slot.name)] = slot;
}

MemoCache::MemoCache(size_t entries) : capacity_(checked_capacity(entries)), places_(capacity_) {
  entries_.reserve(capacity_);
}

void MemoCache::unlink(uint32_t place) {
  const Entry& entry = entries_[place];
  entries_[entry.newer].older = entry.older;
  entries_[entry.older].newer = entry.newer;
}

void MemoCache::make_newest(uint32_t place) {
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

bool MemoCache::request(uint64_t name) {
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

UnboundedMemo::UnboundedMemo() : slots_(least_slots, 0) {}

bool UnboundedMemo::request(uint64_t name) {
  if (name == 0) return !std::exchange(has_zero_, true);
  const size_t mask = slots_.size() - 1;
  size_t slot = home_of(name, slots_.size());
  while (slots_[slot] != 0 && slots_[slot] != name) slot = (slot + 1) & mask;
  if (slots_[slot] == name) return false;
  slots_[slot] = name;
  if (2 * ++size_ > slots_.size()) grow();
  return true;
}

void UnboundedMemo::grow() {
  std::vector<uint64_t> old(2 * slots_.size(), 0);
  old.swap(slots_);
  const size_t mask = slots_.size() - 1;
  for (const uint64_t name : old) {
    if (name == 0) continue;
    size_t slot = home_of(name, slots_.size());
    while (slots_[slot] != 0) slot = (slot + 1) & mask;
    slots_[slot] = name;
  }
}

}  // namespace tessera
