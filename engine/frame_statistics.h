#pragma once
/// Gathers what the workers and stages counted into the frame's Statistics.

#include <chrono>
#include <mutex>

#include "engine/bucket_renderer.h"
#include "engine/plan.h"
#include "engine/statistics.h"

namespace tessera {

/// Starts the clock when constructed. Workers may be added from several threads at once, the rest
/// by one thread while no worker runs.
class FrameStatistics {
 public:
  void setup_done() { setup_s_ = elapsed_s(); }
  void add(const BucketRenderer& worker);
  void add(const GridSource& grids);
  /// Once for each pass and strip of `pixels` pixels.
  void add(const Reconstruction& reconstruction, long pixels);
  /// Once all is shaded.
  void add(const ShaderBindings& shaders) { bounce_bytes_ = bounce_bytes(shaders); }
  void add(const RayTracer& rays) { ray_bytes_ = rays.memory_bytes(); }
  /// The last to be added. Warns if the map is empty, and says why.
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
  double setup_s_ = 0, filter_s_ = 0;
  double bound_samples_ = 0, bound_pixels_ = 0;  // of samples, the sum over pixels
  std::mutex mutex_;
  StageTimes times_;
  HideCounters hide_;
  ShadeCounters shade_;
  DiceCounters dice_;
  FilmCounters film_;
  std::vector<std::pair<std::string, double>> heatmap_;
  uint64_t extra_samples_ = 0;
  size_t peak_grid_bytes_ = 0, ray_bytes_ = 0, bounce_bytes_ = 0;
};

}  // namespace tessera
