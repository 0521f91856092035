#pragma once
/// Where a bucket looks: points (x, y, u, v, t), Owen-scrambled Sobol in all five dimensions.

#include <cstdint>
#include <vector>

#include "base/aligned.h"
#include "base/raster.h"
#include "cameras/lens_profile.h"
#include "cameras/shutter_profile.h"

namespace tessera {

/// The samples of a rectangle of pixels. Sample k of the pixel with row-major index p in `rect` has
/// index p * samples_per_pixel + k, so a run of pixels in a row is a run of samples. Arrays are
/// padded at the end for whole-vector loads; padding holds NaN positions, which nothing covers.
struct SampleBlock {
  PixelRect rect;
  int samples_per_pixel = 0;
  AlignedVector<float> x, y;  ///< raster position, pixels
  AlignedVector<float> u,
      v;  ///< lens coordinates after the profile's warp; empty if the lens is closed
  AlignedVector<float>
      t;  ///< shutter time in [0, 1], ascending within a pixel; empty if nothing moves

  AlignedVector<uint32_t> tuple;  ///< which tuple or line a sample is on; empty if they are free

  size_t size() const { return size_t(rect.pixel_count()) * size_t(samples_per_pixel); }
};

/// Samples whose time and lens position come from a few fixed tuples, or from lines across the
/// lens: what hiders need that rasterise once for each of them.
struct SampleTuples {
  enum class Kind {
    free,         ///< anywhere in (u, v, t)
    interleaved,  ///< `count` tuples (u, v, t), permuted over the samples of each tile of 2 x 2
                  ///< pixels
    accumulated,  ///< `count` tuples (x, y, u, v, t), the same in every pixel
    lens_lines,   ///< (u, v) anywhere on one of `count` lines through the lens centre; t free
  };
  Kind kind = Kind::free;
  int count = 0;
  bool operator==(const SampleTuples&) const = default;
};

/// Makes the samples of any pixel: a function of (pixel, seed) alone, whatever the bucket.
class SamplePattern {
 public:
  /// Null profiles switch the lens or time dimensions off; they must outlive the pattern.
  /// Throws Error unless 1 <= samples_per_pixel <= 65536.
  SamplePattern(int samples_per_pixel, uint32_t seed, const LensProfile* lens,
                const ShutterProfile* shutter);

  int samples_per_pixel() const { return samples_per_pixel_; }
  /// Fills `block` (reusing its storage) with the samples of the pixels of `rect`.
  void fill(const PixelRect& rect, SampleBlock& block) const;

 private:
  void fill_pixel(int x, int y, SampleBlock& block, size_t first, struct PixelPoints& points) const;
  void warp_lens(float* u, float* v, size_t count) const;

  int samples_per_pixel_;
  uint32_t seed_;
  const LensProfile* lens_;
  const ShutterProfile* shutter_;
  int index_bits_;                 // of the smallest power of two >= samples_per_pixel
  bool disc_lens_, box_shutter_;   // the common profiles, mapped without a virtual call a sample
  AlignedVector<uint32_t> sobol_;  // [dimension][index], digits reversed as in sobol.h
};

}  // namespace tessera
