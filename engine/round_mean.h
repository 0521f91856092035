#pragma once
/// The image that several rounds of passes make together, and how far it is from the truth, found
/// without a reference. A round is two passes with the same numbers of samples and independent
/// seeds. With halves a and b of the mean m = (a + b) / 2, (a - b) / 2 has the mean 0 and the
/// variance of m, whatever happens between samples and pixels: it sees stratification and filters
/// as they are.
///
/// What both halves have in common, as the blur of a filter, it does not see. There the plain image
/// u of the same samples helps, which has noise but no bias. With e the error of m and n that of u,
/// (m - u)^2 has the mean of e^2 + n^2 - 2 e n; (u_a - u_b) / 2 has the variance of n, and its
/// covariance with (a - b) / 2 is that of e and n. So
///
///   (m - u)^2 - (u_a - u_b)^2 / 4 + (a - b) (u_a - u_b) / 2
///
/// has the mean of e^2, bias and all (a relative of Stein's estimate, which needs the derivative of
/// the filter instead of a second image). It is much noisier than the square of a difference, so it
/// is taken for the frame as a whole only.

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "engine/sample_allocation.h"
#include "images/image.h"
#include "shade/shade.h"

namespace tessera {

/// Keeps relative errors of dark pixels finite, as relMSE of images/compare.h does.
inline constexpr double relative_floor = 0.01;

/// The two passes of a round.
struct RoundImages {
  Image a, b;
  /// Of the same samples, without bias; absent where `a` and `b` have none themselves.
  std::optional<Image> plain_a, plain_b;
};

class RoundMean {
 public:
  /// `groups`: those of the images, in their order. Colours are linear.
  explicit RoundMean(std::vector<const AovDefinition*> groups) : groups_(std::move(groups)) {}

  /// Adds a round whose passes had `allocation` each. Rounds count by the inverse of their squared
  /// errors, one weight for the whole image: weights of each pixel's own would follow its noise,
  /// and the mean would not be that of the samples. Channels that must not be averaged are those of
  /// the pass that saw the nearest surface.
  void add(RoundImages&& round, const SampleAllocation& allocation);

  bool empty() const { return rounds_ == 0; }
  int rounds() const { return rounds_; }
  const Image& image() const { return best_.image; }
  Image take_image() { return std::move(best_.image); }
  /// Mean over pixels and R, G, B of the expected (value - truth)^2 / (value^2 + relative_floor).
  /// Never below what variance alone comes to.
  double error_squared() const { return error_squared_; }
  /// What of error_squared() is variance.
  double variance() const { return variance_; }
  /// What is known of the noise from all rounds, the later ones counting for more; not smoothed.
  /// Where there is bias, too, it is scaled as if that fell with more samples as variance does.
  PixelNoise noise() const;
  /// Samples of each pixel, of all passes.
  std::span<const uint64_t> samples() const { return samples_; }
  double mean_samples() const;

 private:
  using Colours = std::vector<double>;  // [colour * pixels + pixel]

  struct Estimate {
    Image image;
    Colours differences;               // (a - b) / 2
    Colours plain, plain_differences;  // u and (u_a - u_b) / 2; empty where there is no bias
    double variance() const;
    double error_squared() const;
  };

  void add(Estimate&& newest, double samples);
  void count(const SampleAllocation& allocation, const PixelRect& rect);
  void update_noise(const Estimate& newest, const SampleAllocation& allocation);

  std::vector<const AovDefinition*> groups_;
  Estimate best_;
  PixelNoise noise_;
  std::vector<uint64_t> samples_;
  double variance_ = 0, error_squared_ = 0;
  int rounds_ = 0;
};

}  // namespace tessera
