#pragma once
/// The buckets of a pass over a frame, and the workers that render them.

#include <atomic>
#include <mutex>

#include "engine/bucket_renderer.h"
#include "engine/frame.h"
#include "engine/frame_statistics.h"

namespace tessera {

/// Hands out the buckets of rows, row by row, so that the film and the grids hold a narrow front of
/// the frame.
class BucketQueue {
 public:
  /// `pass` of `passes` as in FrameProgress; `rows`: those that are to be rendered, counted as
  /// often as they are.
  BucketQueue(const BucketLayout& buckets, const FrameControl& control, int pass, int passes,
              int rows)
      : buckets_(buckets), control_(control), progress_{pass, passes, 0, rows * buckets.columns()} {
    if (control_.progress) control_.progress(progress_);
  }

  /// Hands out these rows from now on. Not while others take.
  void begin_rows(int first, int end) {
    next_ = first * buckets_.columns(), end_ = end * buckets_.columns();
  }

  /// False when none is left or the frame is cancelled.
  bool take(int& i, int& j) {
    if (control_.cancel && control_.cancel->load(std::memory_order_relaxed)) return false;
    const int index = next_.fetch_add(1);
    if (index >= end_) return false;
    i = index % buckets_.columns(), j = index / buckets_.columns();
    return true;
  }
  void done() {
    std::lock_guard lock(mutex_);
    ++progress_.buckets_done;
    if (control_.progress) control_.progress(progress_);
  }
  /// No further bucket is handed out.
  void stop() { next_ = end_; }
  bool complete() const { return progress_.buckets_done == progress_.buckets_total; }

 private:
  const BucketLayout& buckets_;
  const FrameControl& control_;
  std::atomic<int> next_{0};
  int end_ = 0;
  std::mutex mutex_;
  FrameProgress progress_;
};

/// Renders every bucket on `threads` workers. An exception in one of them reaches the caller after
/// the others have stopped.
void render_buckets(const FrameParts& parts, int threads, BucketQueue& queue,
                    FrameStatistics& statistics);

}  // namespace tessera
