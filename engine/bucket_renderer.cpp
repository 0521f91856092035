#include "engine/bucket_renderer.h"

#include <algorithm>
#include <chrono>

namespace tessera {
namespace {

/// Adds the seconds since the last lap to a stage's time.
class LapTimer {
 public:
  void lap(double& into_s) {
    const auto now = std::chrono::steady_clock::now();
    into_s += std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace

void BucketRenderer::render(int i, int j) {
  LapTimer timer;
  const auto grids = parts_.grids.grids_of_bucket(i, j);
  timer.lap(times_.dice_s);
  parts_.pattern.fill(parts_.buckets.rect(i, j), samples_);
  if (parts_.heatmap) pixel_counts_.assign(size_t(samples_.rect.pixel_count()), 0);
  timer.lap(times_.sample_s);
  hide(grids);
  timer.lap(times_.hide_s);
  const ShadeInput input = shade_input(grids);
  parts_.shading.shade(input, shaded_, shade_counters_);
  timer.lap(times_.shade_s);
  SampleValues values = composite_samples(input);
  timer.lap(times_.composite_s);
  if (parts_.heatmap) add_to_heatmap();
  parts_.film.add_bucket(i, j, std::move(values));
  timer.lap(times_.reconstruct_s);
  parts_.grids.finish_bucket(i, j);
  timer.lap(times_.dice_s);
}

void BucketRenderer::hide(const std::vector<std::shared_ptr<const Grid>>& grids) {
  hide_grids_.clear();
  for (const auto& grid : grids)
    hide_grids_.push_back({grid.get(), !may_be_transparent(parts_.bindings, *grid->surface)});
  HideInput input;
  input.samples = &samples_;
  input.grids = hide_grids_;
  input.raster_clip = parts_.camera.raster_clip();
  input.near_clip = parts_.camera.near_clip();
  input.far_clip = parts_.camera.far_clip();
  input.lens_extent = parts_.camera.lens_profile().extent();
  input.features = parts_.features;
  if (parts_.heatmap && parts_.heatmap->definition().hide_counts)
    input.*parts_.heatmap->definition().hide_counts = pixel_counts_;
  parts_.hider.hide(input, *scratch_, fragments_, hide_counters_);
}

ShadeInput BucketRenderer::shade_input(std::span<const std::shared_ptr<const Grid>> grids) {
  ShadeInput input{&fragments_, grids, &samples_};
  input.wants_cells =
      std::ranges::any_of(parts_.channel_groups, [](const auto* group) { return group->of_cells; });
  shaded_places_.clear();
  if (parts_.heatmap && parts_.heatmap->definition().shade_places)
    input.*parts_.heatmap->definition().shade_places = &shaded_places_;
  return input;
}

void BucketRenderer::add_to_heatmap() {
  if (parts_.heatmap->definition().hide_counts) {
    parts_.heatmap->add_bucket(samples_.rect, pixel_counts_);
  } else {
    parts_.heatmap->add_places(shaded_places_);
  }
}

SampleValues BucketRenderer::composite_samples(const ShadeInput& input) {
  SampleValues values;
  values.rect = samples_.rect;
  values.samples_per_pixel = samples_.samples_per_pixel;
  values.x.assign(samples_.x.begin(), samples_.x.begin() + long(samples_.size()));
  values.y.assign(samples_.y.begin(), samples_.y.begin() + long(samples_.size()));
  composite(input, shaded_, parts_.camera, parts_.channel_groups, values.groups);
  return values;
}

}  // namespace tessera
