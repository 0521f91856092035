#pragma once
/// All buckets of a frame through one hider, without the rest of the renderer.

#include <algorithm>
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

  HideCounters render() {
    std::vector<std::vector<HideGrid>> grids = grids_of_buckets();
    for (Local& local : locals_) local.counters = {};
    tbb::parallel_for(size_t(0), grids.size(), [&](size_t b) {
      Local& local = locals_.local();
      HideInput input;
      input.samples = &input_.buckets[b];
      input.grids = grids[b];
      input.raster_clip = input_.camera.raster_clip();
      input.near_clip = input_.camera.near_clip(), input.far_clip = input_.camera.far_clip();
      input.lens_extent = input_.camera.lens_profile().extent();
      input.features = input_.features;
      hider_->hide(input, *local.scratch, local.fragments, local.counters);
    });
    HideCounters total;
    for (const Local& local : locals_) merge_counters(total, local.counters);
    return total;
  }

 private:
  struct Local {
    std::unique_ptr<Hider::Scratch> scratch;
    FragmentList fragments;
    HideCounters counters;
  };

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
