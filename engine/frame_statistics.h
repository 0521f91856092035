#pragma once
/// Gathers what the workers and stages counted into the frame's Statistics.

#include <chrono>
#include <mutex>

#include "engine/bucket_renderer.h"
#include "engine/plan.h"
#include "engine/statistics.h"

namespace tessera {

/// Starts the clock when constructed. add() is thread safe.
class FrameStatistics {
 public:
  void setup_done() { setup_s_ = elapsed_s(); }
  void add(const BucketRenderer& worker);
  void add(const GridSource& grids);
  void add(const Reconstruction& reconstruction);
  void add(const RayTracer& rays) { ray_bytes_ = rays.memory_bytes(); }
  /// The last to be added. Warns if the map is empty because the plan's methods do not fill it.
  void add(const HeatmapScale& scale, const Heatmap& map, const FramePlan& plan,
           Diagnostics& diagnostics);

  Statistics finish(const FramePlan& plan, const Scene& scene, const Settings& settings,
                    int threads, const Diagnostics& diagnostics) const;

  /// Of all threads together; between passes.
  double dice_s() const { return times_.dice_s; }
  double elapsed_s() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  double setup_s_ = 0, filter_s_ = 0, bound_samples_ = 0;
  std::mutex mutex_;
  StageTimes times_;
  HideCounters hide_;
  ShadeCounters shade_;
  DiceCounters dice_;
  FilmCounters film_;
  std::vector<std::pair<std::string, double>> heatmap_;
  uint64_t extra_samples_ = 0;
  size_t peak_grid_bytes_ = 0, ray_bytes_ = 0;
};

}  // namespace tessera
