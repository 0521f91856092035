#include "engine/heatmap.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "base/find_named.h"
#include "images/preview.h"

namespace tessera {
namespace {

constexpr HeatmapDefinition definitions[] = {
    {"tests", "samples tested against micropolygons in each pixel", "tests per pixel",
     &HideInput::tests_per_pixel, nullptr},
    {"shading",
     "points shaded in each pixel: where they lie at shutter open, or (pixel, sample) are seen",
     "points per pixel", nullptr, &ShadeInput::shaded_at},
    {"extra",
     "samples of each pixel besides those that all have, where the focal plane is in it; with "
     "--error all its samples",
     "samples per pixel", nullptr, nullptr},
};

/// Control points of the ramp, evenly spaced; CIE L* 0, 16, 32, 51, 69, 84, 98.
constexpr std::array<float, 3> ramp[] = {
    {0.00f, 0.00f, 0.00f}, {0.20f, 0.07f, 0.42f}, {0.52f, 0.13f, 0.45f}, {0.84f, 0.28f, 0.26f},
    {0.97f, 0.55f, 0.10f}, {0.98f, 0.80f, 0.25f}, {1.00f, 1.00f, 0.72f}};
/// Where the lowest value above zero is, so that it can be told from zero.
constexpr double darkest = 0.08;

const std::vector<float>& values_of(const Image& image, std::string_view name) {
  const Image::Channel* channel = image.find_channel(heatmap_channel(name));
  if (!channel) throw Error(fmt::format("the image has no heat map '{}'", name));
  return channel->values;
}

}  // namespace

std::span<const HeatmapDefinition> heatmap_registry() { return definitions; }

const HeatmapDefinition& find_heatmap(std::string_view name) {
  return find_named(definitions, "heat map", name);
}

Heatmap::Heatmap(const HeatmapDefinition& definition, const PixelRect& pixels)
    : definition_(definition), pixels_(pixels), counts_(size_t(pixels.pixel_count()), 0) {}

void Heatmap::add_bucket(const PixelRect& rect, std::span<const uint32_t> counts) {
  if (std::any_of(counts.begin(), counts.end(), [](uint32_t n) { return n > 0; })) filled_ = true;
  const PixelRect part = rect.intersect(pixels_);
  if (part.empty()) return;
  for (int y = part.y0; y < part.y1; ++y) {
    const uint32_t* from =
        &counts[size_t(y - rect.y0) * size_t(rect.width()) + size_t(part.x0 - rect.x0)];
    uint32_t* to =
        &counts_[size_t(y - pixels_.y0) * size_t(pixels_.width()) + size_t(part.x0 - pixels_.x0)];
    for (int x = 0; x < part.width(); ++x) to[x] += from[x];
  }
}

void Heatmap::add_places(std::span<const glm::vec2> raster) {
  const std::scoped_lock lock(places_mutex_);
  for (const glm::vec2& at : raster) {
    const bool inside = at.x >= float(pixels_.x0) && at.x < float(pixels_.x1) &&
                        at.y >= float(pixels_.y0) && at.y < float(pixels_.y1);
    filled_ = true;
    if (!inside) continue;
    const int x = int(std::floor(at.x)) - pixels_.x0, y = int(std::floor(at.y)) - pixels_.y0;
    ++counts_[size_t(y) * size_t(pixels_.width()) + size_t(x)];
  }
}

void Heatmap::add_channel(Image& image) const {
  Image::Channel& channel =
      image.add_channel(heatmap_channel(definition_.name), PixelType::float32);
  std::copy(counts_.begin(), counts_.end(), channel.values.begin());
}

std::string heatmap_channel(std::string_view name) { return fmt::format("heatmap.{}", name); }

HeatmapScale heatmap_scale(const Image& image, std::string_view name) {
  const std::vector<float>& values = values_of(image, name);
  if (values.empty()) return {};
  HeatmapScale scale{std::numeric_limits<double>::infinity(),
                     std::numeric_limits<double>::infinity(), 0, 0};
  for (const float value : values) {
    scale.min = std::min(scale.min, double(value));
    scale.max = std::max(scale.max, double(value));
    if (value > 0) scale.lowest_above_zero = std::min(scale.lowest_above_zero, double(value));
    scale.mean += double(value) / double(values.size());
  }
  if (scale.max == 0) scale.lowest_above_zero = 0;
  return scale;
}

std::string describe_scale(const HeatmapScale& scale, std::string_view name) {
  return fmt::format(
      "heat map {}: min {}, max {}, mean {:.1f} {}; colours: black 0, then logarithmic from {} "
      "(purple) to {} (yellow)",
      name, scale.min, scale.max, scale.mean, find_heatmap(name).unit, scale.lowest_above_zero,
      scale.max);
}

std::array<float, 3> heatmap_colour(float position) {
  constexpr int intervals = int(std::size(ramp)) - 1;
  const float at = std::clamp(position, 0.0f, 1.0f) * float(intervals);
  const int k = std::min(int(at), intervals - 1);
  std::array<float, 3> colour{};
  for (size_t c = 0; c < 3; ++c)
    colour[c] = ramp[k][c] + (at - float(k)) * (ramp[k + 1][c] - ramp[k][c]);
  return colour;
}

Image heatmap_picture(const Image& image, std::string_view name) {
  const std::vector<float>& values = values_of(image, name);
  const HeatmapScale scale = heatmap_scale(image, name);
  const double range =
      scale.max > scale.lowest_above_zero ? std::log(scale.max / scale.lowest_above_zero) : 1.0;
  Image picture(image.display_window, image.data_window);
  picture.pixel_aspect = image.pixel_aspect;
  for (const char* channel : {"R", "G", "B"}) picture.add_channel(channel);
  for (size_t i = 0; i < values.size(); ++i) {
    if (!(values[i] > 0)) continue;
    const double height = std::log(double(values[i]) / scale.lowest_above_zero) / range;
    const auto colour = heatmap_colour(float(darkest + (1 - darkest) * height));
    for (size_t c = 0; c < 3; ++c) picture.channels[c].values[i] = linear_from_srgb(colour[c]);
  }
  return picture;
}

}  // namespace tessera
