#pragma once
/// What a pixel's samples say of the surfaces near it: how far each effect blurs, and what is seen.

#include <array>
#include <vector>

#include "reconstruct/method.h"
#include "reconstruct/moment_layout.h"

namespace tessera {

/// Wedges of one coordinate, in both image axes, a value a pixel; NaN where no sample tells.
struct WedgePlanes {
  std::array<std::vector<float>, 2> low, high;

  bool empty() const { return low[0].empty(); }
  bool known(size_t pixel) const { return low[0][pixel] == low[0][pixel]; }
  /// {0, 0} where not known.
  AxisWedge axis(size_t a, size_t pixel) const {
    return known(pixel) ? AxisWedge{low[a][pixel], high[a][pixel]} : AxisWedge{};
  }
  /// The least distance in pixels that y = 1 is sure to lie away; 0 where not known or where the
  /// wedge holds 0.
  float sure_shift(size_t pixel) const;
};

/// Displacements that all lie near one direction, as those of motion do.
struct BlurLine {
  float dx = 1, dy = 0;  ///< unit, image axes
  AxisWedge wedge;       ///< along it
};
/// Along the middle of a pixel's displacements; a wedge of {0, 0} where not known.
BlurLine blur_line(const WedgePlanes& planes, size_t pixel);

/// Facts of the pixels of a rectangle.
class PixelFacts {
 public:
  PixelFacts() = default;
  PixelFacts(const PixelRect& rect, const DistributionFeatures& features);

  /// Reads the samples of a bucket. Thread safe for buckets that share no pixel. Displacements are
  /// at most max_shift; samples whose slope or extent is not known or not finite tell nothing.
  void add(const SampleValues& values, const SampleSpreads& spreads);

  const PixelRect& rect() const { return rect_; }
  size_t index(int x, int y) const {
    return size_t(y - rect_.y0) * size_t(rect_.width()) + size_t(x - rect_.x0);
  }

  static constexpr float max_shift = 1e6f;  ///< pixels

  std::array<WedgePlanes, blur_count> wedges;
  std::array<std::vector<float>, 3> N;  ///< mean of the samples' normals, unit; zero: nothing seen
  std::vector<uint32_t> surface;        ///< that most samples see, as in SampleSurfaces
  std::vector<float> samples;           ///< how many there are

 private:
  PixelRect rect_;
};

/// Reconstruction::bound_samples() of the pixels of `crop`, within the rectangle of `facts`. Each
/// ray effect acts together with lens and motion; of the two effects the one that asks for more
/// counts.
double mean_bound_samples(const PixelFacts& facts, const PixelRect& crop);

/// The facts of `rect` with wedges averaged over the 5 x 5 pixels around (L. Wu et al. 2017,
/// section 6.2): lows and highs apart, over the pixels that have them; those of ray effects over
/// pixels that show the same surface.
PixelFacts smoothed(const PixelFacts& facts, const PixelRect& rect);
inline constexpr int facts_smoothing_reach = 2;

}  // namespace tessera
