#pragma once
/// Which chunks are diced at the moment, and how much memory their grids take.

#include <atomic>
#include <list>
#include <memory>
#include <mutex>
#include <vector>

#include "dice/chunk.h"

namespace tessera {

/// Holds the grids of chunks until the last bucket that overlaps them is finished, or until the
/// memory budget is exceeded while nobody uses them: then they are diced again when next needed.
/// Thread safe.
class GridStore {
 public:
  using Grids = std::vector<std::shared_ptr<const Grid>>;

  GridStore(std::vector<Chunk> chunks, const std::vector<SurfaceContext>& contexts,
            std::vector<int> buckets_of_chunk, size_t budget_bytes, Diagnostics& diagnostics);

  /// The grids of a chunk, diced now if need be.
  Grids grids_of(uint32_t chunk);
  /// One bucket less waits for the chunk.
  void release(uint32_t chunk);

  DiceCounters counters() const;
  size_t peak_bytes() const { return memory_->peak.load(); }

 private:
  struct Slot {
    std::mutex mutex;  ///< held while dicing
    Grids grids;
    bool is_resident = false, was_diced = false;
    int buckets_left = 0;
    std::list<uint32_t>::iterator age;  ///< in by_age_; valid while resident
  };
  /// Shared with the grids, which may outlive the store.
  struct Memory {
    std::atomic<size_t> now{0}, peak{0};
  };

  Grids dice_now(uint32_t chunk, bool again);
  void evict_over_budget(uint32_t keep);

  const std::vector<Chunk> chunks_;
  const std::vector<SurfaceContext>& contexts_;
  const size_t budget_bytes_;
  Diagnostics& diagnostics_;
  std::vector<Slot> slots_;
  std::shared_ptr<Memory> memory_ = std::make_shared<Memory>();

  mutable std::mutex ages_mutex_;
  std::list<uint32_t> by_age_;  ///< resident chunks, least recently used first
  DiceCounters counters_;       ///< guarded by ages_mutex_
};

}  // namespace tessera
