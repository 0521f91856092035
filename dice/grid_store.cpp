#include "dice/grid_store.h"

#include <algorithm>

namespace tessera {

GridStore::GridStore(std::vector<Chunk> chunks, const std::vector<SurfaceContext>& contexts,
                     std::vector<int> buckets_of_chunk, size_t budget_bytes,
                     Diagnostics& diagnostics)
    : chunks_(std::move(chunks)),
      contexts_(contexts),
      budget_bytes_(budget_bytes),
      diagnostics_(diagnostics),
      slots_(chunks_.size()) {
  for (size_t c = 0; c < slots_.size(); ++c) slots_[c].buckets_left = buckets_of_chunk[c];
}

GridStore::Grids GridStore::dice_now(uint32_t chunk, bool again) {
  DiceCounters counters;
  std::vector<std::unique_ptr<Grid>> grids =
      dice(chunks_[chunk], contexts_[chunks_[chunk].surface], counters, diagnostics_);
  if (again) {
    // The work is counted once, whatever the budget.
    DiceCounters only_again;
    only_again.grids_diced_again = counters.grids;
    counters = only_again;
  }
  Grids shared;
  for (std::unique_ptr<Grid>& grid : grids) {
    const size_t bytes = grid->memory_bytes();
    const size_t now = memory_->now.fetch_add(bytes) + bytes;
    size_t peak = memory_->peak.load();
    while (peak < now && !memory_->peak.compare_exchange_weak(peak, now)) {
    }
    shared.emplace_back(grid.release(), [memory = memory_, bytes](const Grid* dying) {
      delete dying;
      memory->now.fetch_sub(bytes);
    });
  }
  const std::lock_guard lock(ages_mutex_);
  merge_counters(counters_, counters);
  return shared;
}

GridStore::Grids GridStore::grids_of(uint32_t chunk) {
  Slot& slot = slots_[chunk];
  Grids grids;
  {
    const std::lock_guard lock(slot.mutex);
    if (slot.is_resident) {
      const std::lock_guard ages(ages_mutex_);
      by_age_.splice(by_age_.end(), by_age_, slot.age);
      return slot.grids;
    }
    grids = dice_now(chunk, slot.was_diced);
    slot.was_diced = true;
    slot.grids = grids;
    slot.is_resident = true;
    const std::lock_guard ages(ages_mutex_);
    slot.age = by_age_.insert(by_age_.end(), chunk);
  }
  evict_over_budget(chunk);
  return grids;
}

void GridStore::evict_over_budget(uint32_t keep) {
  if (memory_->now.load() <= budget_bytes_) return;
  std::vector<uint32_t> candidates;
  {
    const std::lock_guard ages(ages_mutex_);
    candidates.assign(by_age_.begin(), by_age_.end());
  }
  for (uint32_t candidate : candidates) {
    if (memory_->now.load() <= budget_bytes_) return;
    if (candidate == keep) continue;
    Slot& slot = slots_[candidate];
    // Never wait for a chunk that is being diced or handed out.
    const std::unique_lock lock(slot.mutex, std::try_to_lock);
    if (!lock.owns_lock() || !slot.is_resident) continue;
    const bool in_use = std::any_of(slot.grids.begin(), slot.grids.end(),
                                    [](const auto& grid) { return grid.use_count() > 1; });
    if (in_use) continue;
    slot.grids.clear();
    slot.is_resident = false;
    const std::lock_guard ages(ages_mutex_);
    by_age_.erase(slot.age);
  }
}

void GridStore::release(uint32_t chunk) {
  Slot& slot = slots_[chunk];
  const std::lock_guard lock(slot.mutex);
  if (--slot.buckets_left > 0 || !slot.is_resident) return;
  slot.grids.clear();
  slot.is_resident = false;
  const std::lock_guard ages(ages_mutex_);
  by_age_.erase(slot.age);
}

DiceCounters GridStore::counters() const {
  const std::lock_guard lock(ages_mutex_);
  return counters_;
}

}  // namespace tessera
