#include "engine/extra_samples.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/hash.h"
#include "reconstruct/sampling_rate.h"

namespace tessera {
namespace {

/// Keeps the points of extra samples apart from those that every pixel has.
constexpr uint32_t extra_seed = 0xe87a5u;

/// Fewer are not worth a pass of their own.
constexpr int fewest_extra = 8;

/// Signed circles of confusion that a pixel's samples see.
struct CocRange {
  glm::vec2 low{0.0f}, high{0.0f};
  bool seen = false;

  void add(const glm::vec2& coc) {
    low = seen ? glm::min(low, coc) : coc;
    high = seen ? glm::max(high, coc) : coc;
    seen = true;
  }
  bool both_signs() const { return seen && (low.x < 0) != (high.x < 0) && low.x != high.x; }
};

/// Where a sample of the merged values comes from.
struct Origin {
  bool extra;
  uint32_t sample;
};

void regroup(const std::vector<Origin>& origins, size_t channels, const std::vector<float>& extra,
             std::vector<float>& values) {
  if (values.empty()) return;
  std::vector<float> merged;
  merged.reserve(channels * origins.size());
  const size_t own_count = values.size() / channels, extra_count = extra.size() / channels;
  for (size_t c = 0; c < channels; ++c)
    for (const Origin& from : origins)
      merged.push_back(from.extra ? extra[c * extra_count + from.sample]
                                  : values[c * own_count + from.sample]);
  values = std::move(merged);
}

/// A bucket in which an effect lights nothing has no arrays for it.
void even_out(EffectValues& a, size_t a_count, EffectValues& b, size_t b_count) {
  if (a.empty() == b.empty()) return;
  const bool fill_a = a.empty();
  EffectValues &empty = fill_a ? a : b, &other = fill_a ? b : a;
  empty.resize(fill_a ? a_count : b_count);
  if (!other.drawn[0].empty()) empty.add_drawn();
}

/// Calls f(own, extra) for every array of the two that has one entry a sample.
template <class F>
void for_arrays(DistributionSamples& own, const DistributionSamples& extra, F f) {
  for (size_t e = 0; e < ray_effect_count; ++e) {
    EffectValues& a = own.effects[e];
    const EffectValues& b = extra.effects[e];
    for (size_t c = 0; c < 3; ++c)
      f(a.received[c], b.received[c]), f(a.unblocked[c], b.unblocked[c]), f(a.drawn[c], b.drawn[c]);
    for (size_t c = 0; c < 2; ++c) f(a.y[c], b.y[c]), f(a.extent[c], b.extent[c]);
    f(a.slope, b.slope);
  }
  for (size_t c = 0; c < 2; ++c) {
    f(own.surfaces.coc[c], extra.surfaces.coc[c]);
    f(own.surfaces.velocity[c], extra.surfaces.velocity[c]);
  }
  for (size_t c = 0; c < 3; ++c) f(own.surfaces.N[c], extra.surfaces.N[c]);
  f(own.u, extra.u), f(own.v, extra.v), f(own.t, extra.t);
}

}  // namespace

ExtraPatterns::ExtraPatterns(int most, uint32_t seed, const LensProfile* lens,
                             const ShutterProfile* shutter, SampleExtras extras) {
  for (int samples = std::min(fewest_extra, most);; samples = std::min(2 * samples, most)) {
    patterns_.emplace_back(samples, hash_combine(seed, extra_seed), lens, shutter, SampleTuples{},
                           extras);
    if (samples == most) return;
  }
}

size_t ExtraPatterns::step_for(double samples) const {
  size_t step = 0;
  while (step + 1 < patterns_.size() && patterns_[step].samples_per_pixel() < samples) ++step;
  return step;
}

std::vector<uint8_t> choose_extra(const SampleBlock& samples, const FragmentList& fragments,
                                  const Camera& camera, const ExtraPatterns& patterns) {
  const size_t pixels = size_t(samples.rect.pixel_count());
  const size_t spp = size_t(samples.samples_per_pixel);
  const float extent = camera.lens_profile().extent();
  std::vector<uint8_t> chosen(pixels, 0);
  for (size_t pixel = 0; pixel < pixels; ++pixel) {
    CocRange range;
    for (size_t s = pixel * spp; s < (pixel + 1) * spp; ++s) {
      const uint32_t first = fragments.first_of_sample[s];
      if (first == fragments.first_of_sample[s + 1]) continue;  // it sees nothing
      const glm::vec2 coc = extent * camera.coc_raster(fragments.z[first]);
      if (std::isfinite(coc.x) && std::isfinite(coc.y)) range.add(coc);
    }
    if (!range.both_signs()) continue;
    const EffectWedges lens{{range.low.x, range.high.x}, {range.low.y, range.high.y}};
    const double wanted = samples_by_bound({&lens, 1}) - double(spp);
    if (wanted > 0) chosen[pixel] = uint8_t(1 + patterns.step_for(wanted));
  }
  return chosen;
}

PixelRect bounds_of(const std::vector<uint8_t>& chosen, const PixelRect& rect, uint8_t choice) {
  PixelRect bounds{rect.x1, rect.y1, rect.x0, rect.y0};
  for (size_t pixel = 0; pixel < chosen.size(); ++pixel) {
    if (chosen[pixel] != choice) continue;
    const int x = rect.x0 + int(pixel) % rect.width(), y = rect.y0 + int(pixel) / rect.width();
    bounds.x0 = std::min(bounds.x0, x), bounds.x1 = std::max(bounds.x1, x + 1);
    bounds.y0 = std::min(bounds.y0, y), bounds.y1 = std::max(bounds.y1, y + 1);
  }
  return bounds.x0 < bounds.x1 ? bounds : PixelRect{};
}

void keep_chosen(const std::vector<uint8_t>& chosen, const PixelRect& rect, uint8_t choice,
                 const SampleBlock& samples, FragmentList& fragments) {
  const size_t spp = size_t(samples.samples_per_pixel);
  const auto is_kept = [&](size_t sample) {
    const int pixel = int(sample / spp);
    const int x = samples.rect.x0 + pixel % samples.rect.width();
    const int y = samples.rect.y0 + pixel / samples.rect.width();
    return chosen[size_t(y - rect.y0) * size_t(rect.width()) + size_t(x - rect.x0)] == choice;
  };
  FragmentList kept;
  kept.first_of_sample.push_back(0);
  for (size_t s = 0; s < samples.size(); ++s) {
    const uint32_t first = fragments.first_of_sample[s], last = fragments.first_of_sample[s + 1];
    for (uint32_t f = first; f < last && is_kept(s); ++f) {
      kept.sample.push_back(fragments.sample[f]), kept.grid.push_back(fragments.grid[f]);
      kept.triangle.push_back(fragments.triangle[f]);
      kept.b1.push_back(fragments.b1[f]), kept.b2.push_back(fragments.b2[f]);
      kept.z.push_back(fragments.z[f]), kept.weight.push_back(fragments.weight[f]);
    }
    kept.first_of_sample.push_back(uint32_t(kept.size()));
  }
  fragments = std::move(kept);
}

namespace {

/// For each pixel of `values` that chose(pixel), its samples in `extra`: besides its own or
/// instead of them.
template <class Chose>
void merge_where(const Chose& chose_pixel, bool keeps_own, SampleValues& extra,
                 SampleValues& values) {
  const size_t pixels = size_t(values.rect.pixel_count());
  const auto spp = uint32_t(values.samples_per_pixel), more = uint32_t(extra.samples_per_pixel);
  std::vector<uint32_t> first_of_pixel{0};
  std::vector<Origin> origins;
  for (size_t pixel = 0; pixel < pixels; ++pixel) {
    const bool uniform = values.first_of_pixel.empty();
    const uint32_t first = uniform ? uint32_t(pixel) * spp : values.first_of_pixel[pixel];
    const uint32_t last = uniform ? first + spp : values.first_of_pixel[pixel + 1];
    const bool chose = chose_pixel(pixel);
    for (uint32_t s = first; s < last && (keeps_own || !chose); ++s) origins.push_back({false, s});
    if (chose) {
      const int x = values.rect.x0 + int(pixel) % values.rect.width() - extra.rect.x0;
      const int y = values.rect.y0 + int(pixel) / values.rect.width() - extra.rect.y0;
      const uint32_t from = uint32_t(y * extra.rect.width() + x) * more;
      for (uint32_t k = 0; k < more; ++k) origins.push_back({true, from + k});
    }
    first_of_pixel.push_back(uint32_t(origins.size()));
  }
  const size_t before = values.x.size();
  for (size_t e = 0; e < ray_effect_count; ++e)
    even_out(values.distribution.effects[e], before, extra.distribution.effects[e], extra.x.size());
  const auto merge = [&](std::vector<float>& own, const std::vector<float>& other) {
    regroup(origins, 1, other, own);
  };
  for (size_t g = 0; g < values.groups.size(); ++g)
    regroup(origins, values.groups[g].size() / before, extra.groups[g], values.groups[g]);
  merge(values.x, extra.x), merge(values.y, extra.y);
  for_arrays(values.distribution, extra.distribution, merge);
  std::vector<uint32_t> surface;
  if (!values.distribution.surfaces.surface.empty()) {
    for (const Origin& from : origins)
      surface.push_back(from.extra ? extra.distribution.surfaces.surface[from.sample]
                                   : values.distribution.surfaces.surface[from.sample]);
  }
  values.distribution.surfaces.surface = std::move(surface);
  values.first_of_pixel = std::move(first_of_pixel);
}

}  // namespace

void append_extra(const std::vector<uint8_t>& chosen, uint8_t choice, SampleValues&& extra,
                  SampleValues& values) {
  merge_where([&](size_t pixel) { return chosen[pixel] == choice; }, true, extra, values);
}

std::vector<PixelRect> parts_of(const std::vector<uint8_t>& chosen, const PixelRect& rect,
                                uint8_t choice) {
  std::vector<PixelRect> parts;
  const auto chose = [&](int x, int y) {
    return chosen[size_t(y - rect.y0) * size_t(rect.width()) + size_t(x - rect.x0)] == choice;
  };
  for (int y = rect.y0; y < rect.y1; ++y)
    for (int x = rect.x0; x < rect.x1;) {
      if (!chose(x, y)) {
        ++x;
        continue;
      }
      const int start = x;
      while (x < rect.x1 && chose(x, y)) ++x;
      const auto goes_on = [&](const PixelRect& part) {
        return part.x0 == start && part.x1 == x && part.y1 == y;
      };
      const auto above = std::ranges::find_if(parts, goes_on);
      if (above != parts.end())
        ++above->y1;
      else
        parts.push_back({start, y, x, y + 1});
    }
  return parts;
}

void replace_part(SampleValues&& part, SampleValues& values) {
  const PixelRect rect = part.rect;
  const auto is_in_part = [&](size_t pixel) {
    const int x = values.rect.x0 + int(pixel) % values.rect.width();
    const int y = values.rect.y0 + int(pixel) / values.rect.width();
    return x >= rect.x0 && x < rect.x1 && y >= rect.y0 && y < rect.y1;
  };
  merge_where(is_in_part, false, part, values);
}

SampleValues counted_by_pixel(SampleValues&& values) {
  const auto samples = uint32_t(values.samples_per_pixel);
  for (size_t pixel = 0; pixel <= size_t(values.rect.pixel_count()); ++pixel)
    values.first_of_pixel.push_back(uint32_t(pixel) * samples);
  values.samples_per_pixel = 1;
  return std::move(values);
}

}  // namespace tessera
