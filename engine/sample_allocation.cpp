#include "engine/sample_allocation.h"

#include <algorithm>
#include <cmath>

namespace tessera {
namespace {

/// Share of the mean root of the variance that no pixel falls below.
constexpr double least_share = 0.125;

/// Bisection steps over the logarithm of samples: to 1e-8 and better.
constexpr int bisections = 40;
/// From less than one sample in any pixel of a frame to more than the most in all.
constexpr double least_log2 = -40, most_log2 = 40;

/// Averages lines of `count` values that lie `step` apart, with weights 1 4 6 4 1; ends repeat.
void smooth_line(const double* from, double* to, int count, size_t step) {
  constexpr double weights[] = {1, 4, 6, 4, 1};
  for (int k = 0; k < count; ++k) {
    double sum = 0;
    for (int d = -2; d <= 2; ++d)
      sum += weights[d + 2] * from[size_t(std::clamp(k + d, 0, count - 1)) * step];
    to[size_t(k) * step] = sum / 16;
  }
}

int tile_of(int pixel) { return pixel >> SampleAllocation::tile_bits; }

/// Roots of the mean variance in the tiles that meet a rectangle, as multiples of their mean over
/// its pixels, and the levels that go with them.
class Roots {
 public:
  Roots(const PixelNoise& noise, const PixelRect& rect)
      : rect_(rect), tiles_(rect.empty() ? PixelRect{} : tiles_that_meet(rect)) {
    const size_t count = size_t(tiles_.pixel_count());
    std::vector<double> variance(count, 0.0), pixels(count, 0.0);
    for_pixels([&](int x, int y, size_t tile) {
      variance[tile] += nearest(noise, x, y), pixels[tile] += 1;
    });
    double mean = 0;
    for (size_t tile = 0; tile < count; ++tile) {
      roots_.push_back(std::sqrt(std::max(variance[tile] / pixels[tile], 0.0)));
      mean += roots_[tile] * pixels[tile] / double(rect.pixel_count());
    }
    if (mean > 0)
      for (double& root : roots_) root = std::max(root / mean, least_share);
  }

  /// 2^log2_scale samples for the mean root.
  SampleAllocation at(double log2_scale, const AllocationLimits& limits) const {
    std::vector<uint8_t> levels;
    for (const double root : roots_) {
      const double wanted = root > 0 ? std::round(std::log2(root) + log2_scale) : 0.0;
      levels.push_back(uint8_t(std::clamp(wanted, double(limits.lowest_level),
                                          double(SampleAllocation::highest_level))));
    }
    SampleAllocation result{rect_, {}};
    result.level.reserve(size_t(rect_.pixel_count()));
    for_pixels([&](int, int, size_t tile) { result.level.push_back(levels[tile]); });
    return result;
  }

 private:
  static PixelRect tiles_that_meet(const PixelRect& rect) {
    return {tile_of(rect.x0), tile_of(rect.y0), tile_of(rect.x1 - 1) + 1, tile_of(rect.y1 - 1) + 1};
  }
  static double nearest(const PixelNoise& noise, int x, int y) {
    const PixelRect& known = noise.rect;
    const int near_x = std::clamp(x, known.x0, known.x1 - 1) - known.x0;
    const int near_y = std::clamp(y, known.y0, known.y1 - 1) - known.y0;
    return noise.variance[size_t(near_y) * size_t(known.width()) + size_t(near_x)];
  }
  /// Calls use(x, y, place of its tile) for every pixel, row by row.
  template <class Use>
  void for_pixels(const Use& use) const {
    for (int y = rect_.y0; y < rect_.y1; ++y) {
      const size_t row = size_t(tile_of(y) - tiles_.y0) * size_t(tiles_.width());
      for (int x = rect_.x0; x < rect_.x1; ++x) use(x, y, row + size_t(tile_of(x) - tiles_.x0));
    }
  }

  PixelRect rect_, tiles_;
  std::vector<double> roots_;
};

}  // namespace

std::vector<uint8_t> SampleAllocation::choices(const PixelRect& part) const {
  std::vector<uint8_t> chosen;
  chosen.reserve(size_t(part.pixel_count()));
  for (int y = part.y0; y < part.y1; ++y)
    for (int x = part.x0; x < part.x1; ++x) chosen.push_back(uint8_t(1 + level[index(x, y)]));
  return chosen;
}

double SampleAllocation::mean_samples() const {
  uint64_t sum = 0;
  for (const uint8_t k : level) sum += uint64_t(1) << k;
  return level.empty() ? 0.0 : double(sum) / double(level.size());
}

int SampleAllocation::least_samples() const {
  return level.empty() ? 0 : 1 << *std::ranges::min_element(level);
}

int SampleAllocation::most_samples() const {
  return level.empty() ? 0 : 1 << *std::ranges::max_element(level);
}

SampleAllocation even_allocation(const PixelRect& rect, int level) {
  return {rect, std::vector<uint8_t>(size_t(rect.pixel_count()), uint8_t(level))};
}

PixelNoise smoothed(const PixelNoise& noise) {
  PixelNoise rows = noise, result = noise;
  const size_t width = size_t(noise.rect.width()), height = size_t(noise.rect.height());
  for (size_t y = 0; y < height; ++y)
    smooth_line(noise.variance.data() + y * width, rows.variance.data() + y * width, int(width), 1);
  for (size_t x = 0; x < width; ++x)
    smooth_line(rows.variance.data() + x, result.variance.data() + x, int(height), width);
  return result;
}

double expected_error_squared(const PixelNoise& noise, const SampleAllocation& allocation) {
  double sum = 0;
  size_t at = 0;
  for (int y = noise.rect.y0; y < noise.rect.y1; ++y)
    for (int x = noise.rect.x0; x < noise.rect.x1; ++x)
      sum += noise.variance[at++] / double(allocation.samples(x, y));
  return at > 0 ? sum / double(at) : 0.0;
}

SampleAllocation allocate(const PixelNoise& noise, const PixelRect& rect, double error_squared,
                          const AllocationLimits& limits) {
  const auto enough = [&](const SampleAllocation& a) {
    return a.mean_samples() >= limits.least_mean_samples &&
           expected_error_squared(noise, a) <= error_squared;
  };
  const auto affordable = [&](const SampleAllocation& a) {
    return a.mean_samples() <= limits.most_mean_samples;
  };
  if (!limits.adaptive) {
    int level = limits.lowest_level;
    while (level < SampleAllocation::highest_level && !enough(even_allocation(rect, level)) &&
           affordable(even_allocation(rect, level + 1)))
      ++level;
    return even_allocation(rect, level);
  }
  const Roots roots(noise, rect);
  double low = least_log2, high = most_log2;  // neither more than enough at low nor less at high
  for (int k = 0; k < bisections; ++k) {
    const double middle = 0.5 * (low + high);
    const SampleAllocation a = roots.at(middle, limits);
    (enough(a) || !affordable(a) ? high : low) = middle;
  }
  const SampleAllocation above = roots.at(high, limits);
  return affordable(above) ? above : roots.at(low, limits);
}

}  // namespace tessera
