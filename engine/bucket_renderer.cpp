#include "engine/bucket_renderer.h"

#include <algorithm>

namespace tessera {

void BucketRenderer::render(int i, int j) {
  timer_.start();
  const Grids grids = parts_.grids.grids_of_bucket(i, j);
  timer_.lap(times_.dice_s);
  const PixelRect rect = parts_.buckets.rect(i, j);
  const Strip& strip = parts_.strip;
  heatmap_ = j >= strip.first_new_row ? parts_.heatmap : nullptr;
  parts_.film.add_bucket(i, j - strip.first_row,
                         parts_.allocation ? allocated(rect, grids) : even(rect, grids));
  timer_.lap(times_.reconstruct_s);
  if (!parts_.keep_grids && j < strip.end_last_row) parts_.grids.finish_bucket(i, j);
  timer_.lap(times_.dice_s);
}

/// The samples of the frame's pattern, and more of them where the lens asks for it.
SampleValues BucketRenderer::even(const PixelRect& rect, const Grids& grids) {
  visit(*parts_.pattern, rect, grids);
  std::vector<uint8_t> chosen;
  if (parts_.extra) chosen = choose_extra(samples_, fragments_, parts_.camera, *parts_.extra);
  SampleValues values = shade(grids);
  if (parts_.extra) add_extra(chosen, grids, values);
  return values;
}

/// The samples of each pixel's level. The lowest is visited everywhere, for a start.
SampleValues BucketRenderer::allocated(const PixelRect& rect, const Grids& grids) {
  const std::vector<uint8_t> chosen = parts_.allocation->choices(rect);
  const auto [lowest, highest] = std::ranges::minmax(chosen);
  SampleValues values;
  for (int choice = lowest; choice <= highest; ++choice) {
    const auto level = uint8_t(choice);
    if (std::ranges::find(chosen, level) == chosen.end()) continue;
    const SamplePattern& pattern = parts_.levels->pattern(choice - 1);
    if (choice == lowest) {
      visit(pattern, rect, grids);
      if (lowest != highest) keep_chosen(chosen, rect, level, samples_, fragments_);
      values = counted_by_pixel(shade(grids));
    } else {
      for (const PixelRect& part : parts_of(chosen, rect, level)) {
        visit(pattern, part, grids);
        replace_part(shade(grids), values);
      }
    }
    map_samples(chosen, level, rect, uint32_t(pattern.samples_per_pixel()));
  }
  return values;
}

/// Finds what the pattern's samples in `rect` see.
void BucketRenderer::visit(const SamplePattern& pattern, const PixelRect& rect,
                           const Grids& grids) {
  pattern.fill(rect, samples_);
  if (heatmap_) pixel_counts_.assign(size_t(rect.pixel_count()), 0);
  timer_.lap(times_.sample_s);
  hide(grids);
  timer_.lap(times_.hide_s);
}

/// Shades and composites what was seen last.
SampleValues BucketRenderer::shade(const Grids& grids) {
  const ShadeInput input = shade_input(grids);
  parts_.shading.shade(input, shaded_, shade_counters_);
  timer_.lap(times_.shade_s);
  SampleValues values = composite_samples(input);
  timer_.lap(times_.composite_s);
  if (heatmap_) add_to_heatmap();
  return values;
}

void BucketRenderer::add_extra(const std::vector<uint8_t>& chosen, const Grids& grids,
                               SampleValues& values) {
  const PixelRect rect = values.rect;
  for (size_t step = 0; step < parts_.extra->steps(); ++step) {
    const auto choice = uint8_t(1 + step);
    const PixelRect bounds = bounds_of(chosen, rect, choice);
    if (bounds.empty()) continue;
    const SamplePattern& pattern = parts_.extra->pattern(step);
    visit(pattern, bounds, grids);
    keep_chosen(chosen, rect, choice, samples_, fragments_);
    append_extra(chosen, choice, shade(grids), values);
    const auto samples = uint32_t(pattern.samples_per_pixel());
    extra_samples_ += uint64_t(std::ranges::count(chosen, choice)) * samples;
    map_samples(chosen, choice, rect, samples);
  }
}

void BucketRenderer::map_samples(const std::vector<uint8_t>& chosen, uint8_t choice,
                                 const PixelRect& rect, uint32_t samples) {
  if (!heatmap_ || !heatmap_->definition().extra()) return;
  pixel_counts_.assign(chosen.size(), 0);
  for (size_t pixel = 0; pixel < chosen.size(); ++pixel)
    if (chosen[pixel] == choice) pixel_counts_[pixel] = samples;
  heatmap_->add_bucket(rect, pixel_counts_);
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
  if (heatmap_ && heatmap_->definition().hide_counts)
    input.*heatmap_->definition().hide_counts = pixel_counts_;
  parts_.hider.hide(input, *scratch_, fragments_, hide_counters_);
}

ShadeInput BucketRenderer::shade_input(std::span<const std::shared_ptr<const Grid>> grids) {
  ShadeInput input{&fragments_, grids, &samples_};
  input.wants_cells =
      std::ranges::any_of(parts_.channel_groups, [](const auto* group) { return group->of_cells; });
  shaded_places_.clear();
  if (heatmap_ && heatmap_->definition().shade_places)
    input.*heatmap_->definition().shade_places = &shaded_places_;
  return input;
}

void BucketRenderer::add_to_heatmap() {
  if (heatmap_->definition().hide_counts)
    heatmap_->add_bucket(samples_.rect, pixel_counts_);
  else if (heatmap_->definition().shade_places)
    heatmap_->add_places(shaded_places_);
}

SampleValues BucketRenderer::composite_samples(const ShadeInput& input) {
  SampleValues values;
  values.rect = samples_.rect;
  values.samples_per_pixel = samples_.samples_per_pixel;
  values.x.assign(samples_.x.begin(), samples_.x.begin() + long(samples_.size()));
  values.y.assign(samples_.y.begin(), samples_.y.begin() + long(samples_.size()));
  composite(input, shaded_, parts_.camera, parts_.channel_groups, values.groups);
  if (parts_.describe_samples)
    describe_samples(input, shaded_, parts_.camera, parts_.features.lens, parts_.features.motion,
                     values.distribution);
  return values;
}

}  // namespace tessera
