#pragma once
/// How many samples each pixel of a pass gets, in powers of two, and which number of them brings
/// the error of a frame down to where it is wanted.

#include <cstdint>
#include <memory>
#include <vector>

#include "base/raster.h"
#include "hide/samples.h"

namespace tessera {

/// 2^level samples for each pixel of `rect`. Tiles of the frame are allocated as a whole: what sees
/// a rectangle of equal samples costs as much as in an even frame, while single pixels would have
/// hiders test the samples of all others around.
struct SampleAllocation {
  static constexpr int highest_level = 14;
  static constexpr int tile_bits = 4;  ///< tiles are 16 pixels wide and start at pixel (0, 0)

  PixelRect rect;
  std::vector<uint8_t> level;  ///< row-major

  size_t index(int x, int y) const {
    return size_t(y - rect.y0) * size_t(rect.width()) + size_t(x - rect.x0);
  }
  int samples(int x, int y) const { return 1 << level[index(x, y)]; }
  /// 1 + the level of the pixels of `part`, row-major: choices of BucketRenderer.
  std::vector<uint8_t> choices(const PixelRect& part) const;
  double mean_samples() const;
  int least_samples() const;
  int most_samples() const;
};

/// Every pixel has the same level.
SampleAllocation even_allocation(const PixelRect& rect, int level);

/// What is known of a frame's noise: for each pixel of `rect` the variance of its mean over R, G
/// and B with one sample a pixel, over mean^2 + 0.01.
struct PixelNoise {
  PixelRect rect;
  std::vector<double> variance;  ///< row-major
};

/// Noise of a pixel estimated from two images is itself noise: averages over the pixels around,
/// with binomial weights. A pixel's samples count in its neighbours too, so nothing sharper is of
/// use.
PixelNoise smoothed(const PixelNoise& noise);

/// Bounds of an allocation.
struct AllocationLimits {
  int lowest_level = 0;
  double least_mean_samples = 0;  ///< at most most_mean_samples
  double most_mean_samples = 1;   ///< mean over the pixels; `lowest_level` everywhere may exceed it
  bool adaptive = true;           ///< false: all pixels alike
};

/// The mean over noise.rect of variance / samples: what the allocation, which covers noise.rect,
/// lets one expect.
double expected_error_squared(const PixelNoise& noise, const SampleAllocation& allocation);

/// The fewest samples that bring expected_error_squared() down to `error_squared`, or, where the
/// limits do not let it come down as far, as many as they let. Of all allocations with one mean,
/// samples proportional to the root of a tile's mean variance have the least expected error
/// (Lagrange); they are rounded to powers of two. No tile gets less than an eighth of what it would
/// with the mean root: that two images agree by chance is no proof that there is nothing to see.
/// Pixels of `rect` outside noise.rect go by the nearest within.
SampleAllocation allocate(const PixelNoise& noise, const PixelRect& rect, double error_squared,
                          const AllocationLimits& limits);

/// The sample patterns of a pass, one for each level that occurs in its allocation. Made once a
/// pass.
class LevelPatterns {
 public:
  /// As those of SamplePattern; `tuples_of(samples)`: what the hider wants.
  template <class TuplesOf>
  LevelPatterns(const SampleAllocation& allocation, uint32_t seed, const LensProfile* lens,
                const ShutterProfile* shutter, SampleExtras extras, TuplesOf tuples_of)
      : patterns_(SampleAllocation::highest_level + 1) {
    for (const uint8_t level : allocation.level)
      if (!patterns_[level])
        patterns_[level] = std::make_unique<SamplePattern>(1 << level, seed, lens, shutter,
                                                           tuples_of(1 << level), extras);
  }
  const SamplePattern& pattern(int level) const { return *patterns_[size_t(level)]; }

 private:
  std::vector<std::unique_ptr<const SamplePattern>> patterns_;
};

}  // namespace tessera
