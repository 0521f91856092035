#pragma once
/// All buckets of a frame through one hider, without the rest of the renderer.

#include <algorithm>
#include <chrono>
#include <string>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "cameras/camera.h"
#include "hide/hide.h"

namespace tessera {

/// What a benchmark has made beforehand, and keeps alive.
struct HiderFrameInput {
  const Camera& camera;
  const std::vector<std::unique_ptr<Grid>>& grids;  ///< with raster_bounds and z_min
  const std::vector<SampleBlock>& buckets;          ///< row-major, with their samples
  int bucket_columns = 1;
  int bucket_size = 64;  ///< pixels
  HideFeatures features;
  bool nearest_first = true;  ///< as a grid source gives them; false: so that depth culls nothing
};

class HiderFrame {
 public:
  HiderFrame(const HiderFrameInput& input, const std::string& hider)
      : input_(input), hider_(make_hider(hider)), locals_([this] {
          return Local{hider_->make_scratch(), {}, {}};
        }) {}

  /// Hides every `every`-th bucket, from the middle one of the first `every` on: all, unless told.
  HideCounters render(int every = 1) {
    const std::vector<std::vector<HideGrid>> grids = grids_of_buckets();
    std::vector<size_t> chosen;
    for (size_t b = size_t(every) / 2; b < grids.size(); b += size_t(every)) chosen.push_back(b);
    for (Local& local : locals_) local.counters = {};
    tbb::parallel_for(size_t(0), chosen.size(),
                      [&](size_t c) { hide_bucket(chosen[c], grids[chosen[c]], locals_.local()); });
    HideCounters total;
    for (const Local& local : locals_) merge_counters(total, local.counters);
    return total;
  }

  /// A guess at the seconds that render() takes on `threads` threads, from a few buckets and, as a
  /// hider may be very slow, few of their grids: more and more of them until they take long enough
  /// to be timed. Too high for a hider that would skip many of the rest by depth.
  double predict_s(int threads) {
    constexpr int sampled = 3, first_share = 64;
    constexpr double long_enough_s = 0.02;
    const std::vector<std::vector<HideGrid>> grids = grids_of_buckets();
    double seconds = 0, expected = 0;
    for (int share = first_share; share >= 1 && seconds < long_enough_s; share /= 4) {
      seconds = expected = 0;
      for (int k = 0; k < sampled; ++k) {
        const size_t b = sampled_bucket(k, sampled);
        std::vector<HideGrid> some;
        for (size_t g = 0; g < grids[b].size(); g += size_t(share)) some.push_back(grids[b][g]);
        if (some.empty()) continue;
        const double taken = seconds_to_hide(b, some);
        seconds += taken;
        expected += taken * double(grids[b].size()) / double(some.size());
      }
    }
    return expected / sampled * double(grids.size()) / threads;
  }

 private:
  struct Local {
    std::unique_ptr<Hider::Scratch> scratch;
    FragmentList fragments;
    HideCounters counters;
  };

  void hide_bucket(size_t b, std::span<const HideGrid> grids, Local& local) const {
    HideInput input;
    input.samples = &input_.buckets[b];
    input.grids = grids;
    input.raster_clip = input_.camera.raster_clip();
    input.near_clip = input_.camera.near_clip(), input.far_clip = input_.camera.far_clip();
    input.lens_extent = input_.camera.lens_profile().extent();
    input.features = input_.features;
    hider_->hide(input, *local.scratch, local.fragments, local.counters);
  }

  double seconds_to_hide(size_t b, std::span<const HideGrid> grids) {
    Local& local = locals_.local();
    const auto start = std::chrono::steady_clock::now();
    hide_bucket(b, grids, local);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }

  /// On the diagonal of the frame: the k-th of `count` buckets evenly spread along it.
  size_t sampled_bucket(int k, int count) const {
    const int columns = input_.bucket_columns, rows = int(input_.buckets.size()) / columns;
    const int i = (2 * k + 1) * columns / (2 * count), j = (2 * k + 1) * rows / (2 * count);
    return size_t(j * columns + i);
  }

  std::vector<std::vector<HideGrid>> grids_of_buckets() const {
    std::vector<const Grid*> ordered;
    for (const auto& grid : input_.grids) ordered.push_back(grid.get());
    std::stable_sort(ordered.begin(), ordered.end(),
                     [](const Grid* a, const Grid* b) { return a->z_min < b->z_min; });
    if (!input_.nearest_first) std::reverse(ordered.begin(), ordered.end());
    std::vector<std::vector<HideGrid>> result(input_.buckets.size());
    const int columns = input_.bucket_columns, rows = int(result.size()) / columns;
    const auto bucket_at = [&](float position, int count) {
      return int(std::clamp(position / float(input_.bucket_size), 0.0f, float(count - 1)));
    };
    for (const Grid* grid : ordered) {
      const RasterBounds& r = grid->raster_bounds;
      for (int j = bucket_at(r.y_min, rows); j <= bucket_at(r.y_max, rows); ++j)
        for (int i = bucket_at(r.x_min, columns); i <= bucket_at(r.x_max, columns); ++i)
          result[size_t(j * columns + i)].push_back({grid, true});
    }
    return result;
  }

  HiderFrameInput input_;
  std::unique_ptr<Hider> hider_;
  tbb::enumerable_thread_specific<Local> locals_;
};

}  // namespace tessera
