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
  /// [pixel, row-major] its first sample, and one past the last at the end, where some pixels have
  /// more samples; each counts for less then. Empty: samples_per_pixel each.
  std::vector<uint32_t> first_of_pixel;
  std::vector<float> x, y;  ///< raster position, pixels
  /// [group][channel * samples + sample], groups as in FilmSettings.
  std::vector<std::vector<float>> groups;
  /// [channel * samples + sample] Channels that only FilmSettings::products read.
  std::vector<float> carried;
  /// Only where a method for distribution effects runs.
  DistributionSamples distribution;
};

/// Sums of products over a pixel's footprint: every factor times every value, both by their place
/// among the carried channels, filtered as one channel each.
struct SampleProducts {
  size_t first_factor = 0, factor_count = 0, first_value = 0, value_count = 0;
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
  std::vector<SampleProducts> products;
};

struct FilmCounters {
  uint64_t pixels = 0, nonfinite_samples_dropped = 0;
  uint64_t pixel_values_bounded = 0;  ///< of filtered channels, that left the range of floats
  static constexpr auto fields() {
    using C = FilmCounters;
    return std::array{CounterField<C>{"pixels", &C::pixels},
                      CounterField<C>{"nonfinite_samples_dropped", &C::nonfinite_samples_dropped},
                      CounterField<C>{"pixel_values_bounded", &C::pixel_values_bounded}};
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
  /// After finish(): [product] the sums of FilmSettings::products over the crop, row after row, in
  /// the order of products, factors, values. 0 where nothing arrived or the sum is not finite.
  std::vector<std::vector<float>> take_products();
  FilmCounters counters() const;
  /// Largest number of buckets whose samples were held at once.
  int peak_blocks() const;

 private:
  class Blocks;
  std::unique_ptr<Blocks> blocks_;
};

class ReconstructionMethod;

/// Which distribution effects a frame has.
struct DistributionFeatures {
  bool lens = false, motion = false;  ///< as in HideFeatures
  bool shadow = false, bounce = false;
  bool any() const { return lens || motion || shadow || bounce; }
};

/// Half widths of uniform distributions with the standard deviations of samples' u and v, and t.
struct SampleSpreads {
  float lens = disc_spread, time = 0.5f;
};

struct ReconstructionSettings {
  FilmSettings film;
  std::shared_ptr<const ReconstructionMethod> method;  ///< null: the pixel filter alone
  DistributionFeatures features;
  int threads = 1;
  size_t memory_bytes = size_t(8) << 30;  ///< that reconstruction_bytes() must not exceed
  SampleSpreads spreads;
};

/// The whole stage: samples of buckets go in as into Film; with a method for distribution effects
/// the whole frame's moments are filtered when the last bucket is in.
class Reconstruction {
 public:
  virtual ~Reconstruction() = default;
  /// Thread safe; each bucket once.
  virtual void add_bucket(int i, int j, SampleValues&& values) = 0;
  /// As Film::finish().
  virtual Image finish() = 0;
  virtual FilmCounters counters() const = 0;
  /// Samples a pixel that axis-aligned filtering asks for by its own bound
  /// (reconstruct/sampling_rate.h): the mean over the pixels of the crop, each counted with no
  /// fewer than it had and no more than most_bound_samples. After finish(); 0 where nothing was
  /// filtered.
  virtual double bound_samples() const { return 0; }
  static constexpr double most_bound_samples = 256;
  virtual double filter_s() const { return 0; }  ///< seconds that finish() spent filtering
};

/// The method that "name" or "name:arguments" asks for (reconstruct/method.h); null for "filter",
/// the pixel filter alone. It keeps what it has computed for all that use it. Throws Error for an
/// unknown method, listing the choices, or bad arguments.
std::shared_ptr<const ReconstructionMethod> make_reconstruction_method(std::string_view spec);

/// What make_reconstruction() holds at the most while its filters run: the moments of the pixels it
/// filters, what is known of them, and what filters make of them. 0 for the film alone, which keeps
/// a front of buckets. Samples of buckets that wait for others come on top.
size_t reconstruction_bytes(const ReconstructionSettings& settings);

/// Throws Error when it would take more memory than the settings allow.
std::unique_ptr<Reconstruction> make_reconstruction(const ReconstructionSettings& settings);

/// Pixels around a crop that the method needs besides the pixel filter's. Throws Error as
/// make_reconstruction_method().
int reconstruction_reach(std::string_view method);

}  // namespace tessera
