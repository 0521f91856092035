#pragma once
/// Stage header: reconstruct. The composited samples of each bucket go in, in any order and from
/// any thread; pixels come out. A pixel sums its footprint in one order, pixels in raster order and
/// samples by index, so the image does not depend on the bucket size, the order of buckets or the
/// number of threads.

#include <memory>
#include <string>
#include <vector>

#include "base/counters.h"
#include "base/raster.h"
#include "images/image.h"
#include "shade/shade.h"

namespace tessera {

/// What a bucket's samples came to. Sample indices are those of SampleBlock.
struct SampleValues {
  PixelRect rect;
  int samples_per_pixel = 0;  ///< the same in every bucket of a frame
  std::vector<float> x, y;    ///< raster position, pixels
  /// [group][channel * samples + sample], groups as in FilmSettings.
  std::vector<std::vector<float>> groups;
};

struct FilmSettings {
  PixelRect display_window;  ///< the whole frame
  PixelRect crop;            ///< the pixels wanted
  PixelRect sampled;         ///< the pixels that buckets bring; empty: those of `crop`
  int bucket_size = 32;      ///< bucket (i, j) starts at sampled.x0 + i * bucket_size, ...
  std::string filter = "gaussian";
  float filter_x_width = 2, filter_y_width = 2;  ///< full widths, pixels
  /// The channel groups that samples carry. One of them must be "z" if any is `closest`: the
  /// nearest of a pixel's own samples gives the value.
  std::vector<const AovDefinition*> groups;
  float exposure_gain = 1, exposure_gamma = 1;  ///< pixel = (gain * value)^(1 / gamma), rgb only
};

struct FilmCounters {
  uint64_t pixels = 0, nonfinite_samples_dropped = 0;
  static constexpr auto fields() {
    using C = FilmCounters;
    return std::array{CounterField<C>{"pixels", &C::pixels},
                      CounterField<C>{"nonfinite_samples_dropped", &C::nonfinite_samples_dropped}};
  }
};

/// The pixels whose samples a filter of these full widths needs for the pixels of `crop`, within
/// the frame: rendered with them, a crop has the pixels of the whole frame.
PixelRect sampled_pixels(const PixelRect& crop, const PixelRect& frame, float filter_x_width,
                         float filter_y_width);

/// Turns samples into pixels. A bucket's samples are kept until all buckets within the filter's
/// reach have arrived, then its pixels are finished by the thread that brought the last of them.
class Film {
 public:
  /// Throws Error for an unknown filter or a width outside (0, 64].
  explicit Film(const FilmSettings& settings);
  ~Film();

  /// Thread safe; each bucket once.
  void add_bucket(int i, int j, SampleValues&& values);
  /// The image over the crop window. Buckets that never arrived are background; pixels whose
  /// footprint reaches into them use what there is.
  Image finish();
  FilmCounters counters() const;
  /// Largest number of buckets whose samples were held at once.
  int peak_blocks() const;

 private:
  class Blocks;
  std::unique_ptr<Blocks> blocks_;
};

}  // namespace tessera
