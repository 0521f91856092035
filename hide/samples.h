#pragma once
/// Where a bucket looks: points (x, y, u, v, t), Owen-scrambled Sobol in all five dimensions.

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "base/aligned.h"
#include "base/raster.h"
#include "hide/sample_warps.h"

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

  /// Places on lights and directions of bounces, [0, 1)^2: for rays of the sample's own. Empty
  /// unless the pattern was asked for them.
  AlignedVector<float> light_x, light_y, bounce_x, bounce_y;

  /// Its tuple, numbered in order of time, or its line; 0 in the padding. Empty if samples are
  /// free.
  AlignedVector<uint32_t> tuple;
  /// With neither lens nor time and a power of two of samples a pixel: sample k of each pixel lies
  /// in the k-th of samples_per_pixel equal strips of y, so that an interval of y is a run of
  /// samples.
  bool y_stratified = false;

  size_t size() const { return size_t(rect.pixel_count()) * size_t(samples_per_pixel); }
};

/// Samples whose time and lens position come from a few fixed tuples, or from lines across the
/// lens: what hiders need that rasterise once for each of them. What a frame has no use for (lens,
/// time) is absent from the tuples too.
struct SampleTuples {
  enum class Kind {
    free,         ///< anywhere in (u, v, t)
    interleaved,  ///< `count` tuples (u, v, t), permuted over the samples of each tile of 2 x 2
                  ///< pixels that starts at even coordinates
    accumulated,  ///< `count` tuples (x, y, u, v, t), the same in every pixel
    lens_lines,   ///< (u, v) anywhere on one of `count` lines through the lens centre; t free
  };
  Kind kind = Kind::free;
  int count = 0;
  bool operator==(const SampleTuples&) const = default;
};

/// Coordinates that a frame's samples carry for rays of their own. Each pair takes the first
/// samples_per_pixel points of a (0, 2)-sequence in each pixel, a (0, m, 2)-net where that is a
/// power of two, scrambled apart from other pixels and pairs. Samples take them in an order of the
/// pair's own that keeps aligned blocks of a power of two together: samples that follow one another
/// in time (or in u, or y) are well spread over the pair too, and tell nothing of it.
struct SampleExtras {
  bool light = false, bounce = false;
};

/// "free", "interleaved:64", ...
std::string to_string(const SampleTuples& tuples);

/// Unit vector along a lens line, at pi * line / count from the u axis towards v. Samples on it are
/// at s times this, |s| at most the lens extent.
glm::vec2 lens_line_direction(int line, int count);

/// The tuples of a frame.
struct TupleTable {
  AlignedVector<float> x, y;  ///< [tuple] position in the pixel, [0, 1); empty unless accumulated
  AlignedVector<float> u, v, t;  ///< [tuple] as in SampleBlock; empty without lens or motion
  std::vector<uint32_t> number;  ///< [point of the Sobol sequence] its tuple
};

/// Makes the samples of any pixel: a function of (pixel, seed) alone, whatever the bucket.
///
/// Interleaved tuples are Sobol points in (u, v, t), scrambled by the frame's seed; a tile of 2 x 2
/// pixels takes each 4 * samples_per_pixel / count times (InterleaveUVT of Fatahalian et al. 2009,
/// as in Laine et al. 2011, section 2). The shuffle of a tile keeps aligned blocks of the sequence
/// together, so that with powers of two the tuples of each pixel are stratified as well. Each
/// accumulated tuple (an accumulation buffer) is taken samples_per_pixel / count times in each
/// pixel.
///
/// Each lens line has samples_per_pixel / count samples in each pixel, or as near as can be; which
/// lines have one more varies from pixel to pixel. They are stratified along the line with a
/// density proportional to the distance from the centre, so that all lines together sample the disc
/// of radius LensProfile::extent() uniformly by area. Profiles of another shape or density are
/// replaced by that disc.
class SamplePattern {
 public:
  /// Null profiles switch the lens or time dimensions off; they must outlive the pattern.
  /// Throws Error unless 1 <= samples_per_pixel <= 65536 and the tuples come out even.
  SamplePattern(int samples_per_pixel, uint32_t seed, const LensProfile* lens,
                const ShutterProfile* shutter, SampleTuples tuples = {}, SampleExtras extras = {});

  int samples_per_pixel() const { return samples_per_pixel_; }
  const SampleTuples& tuples() const { return tuples_; }
  /// Fills `block` (reusing its storage) with the samples of the pixels of `rect`.
  void fill(const PixelRect& rect, SampleBlock& block) const;

 private:
  bool y_stratified() const;
  void fill_pixel(int x, int y, SampleBlock& block, size_t first, struct PixelPoints& points) const;
  void select_points(uint32_t pixel_seed, PixelPoints& points) const;
  void fill_free(int x, int y, SampleBlock& block, size_t first, PixelPoints& points) const;
  void fill_tuples(int x, int y, SampleBlock& block, size_t first, PixelPoints& points) const;
  void fill_lines(int x, int y, SampleBlock& block, size_t first, PixelPoints& points) const;
  void fill_extras(SampleBlock& block) const;
  void fill_pair(const PixelRect& rect, uint32_t pair, AlignedVector<float>& a,
                 AlignedVector<float>& b) const;

  int samples_per_pixel_;
  uint32_t seed_;
  SampleWarps warps_;
  SampleTuples tuples_;
  SampleExtras extras_;
  TupleTable table_;
  std::vector<glm::vec2> line_;    // [line] direction times the lens extent
  int index_bits_;                 // of the smallest power of two >= samples_per_pixel
  AlignedVector<uint32_t> sobol_;  // [dimension][index], digits reversed as in sobol.h
};

}  // namespace tessera
