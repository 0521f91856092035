#include "engine/strips.h"

#include <algorithm>

namespace tessera {

PixelRect Strip::sampled(const BucketLayout& buckets) const {
  const PixelRect& all = buckets.sampled;
  return PixelRect{all.x0, all.y0 + first_row * buckets.size, all.x1,
                   all.y0 + end_row * buckets.size}
      .intersect(all);
}

std::vector<Strip> cut_into_strips(const BucketLayout& buckets, const PixelRect& crop, int reach,
                                   int count) {
  const int height = crop.height(), y0 = buckets.sampled.y0;
  count = std::clamp(count, 1, std::max(height, 1));
  std::vector<Strip> strips;
  for (int k = 0; k < count; ++k) {
    Strip& strip = strips.emplace_back();
    const auto edge = [&](int n) { return crop.y0 + int(long(height) * n / count); };
    strip.crop = {crop.x0, edge(k), crop.x1, edge(k + 1)};
    strip.first_row = k == 0 ? 0 : std::max(0, (strip.crop.y0 - reach - y0) / buckets.size);
    const int last = strip.crop.y1 + reach - 1;
    strip.end_row = k + 1 == count ? buckets.rows()
                                   : std::clamp((last - y0) / buckets.size + 1, 0, buckets.rows());
    strip.end_last_row = strip.end_row;
    if (k == 0) continue;
    Strip& before = strips[size_t(k) - 1];
    strip.first_new_row = before.end_row;
    before.end_last_row = std::min(strip.first_row, before.end_row);
  }
  return strips;
}

void append_strip(Image&& strip, Image& whole) {
  if (whole.channels.empty()) {
    whole = std::move(strip);
    return;
  }
  whole.data_window.y1 = strip.data_window.y1;
  for (size_t c = 0; c < whole.channels.size(); ++c) {
    const std::vector<float>& below = strip.channels[c].values;
    whole.channels[c].values.insert(whole.channels[c].values.end(), below.begin(), below.end());
  }
}

}  // namespace tessera
