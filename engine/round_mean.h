#pragma once
/// The image that several rounds of passes make together, and how far it is from the truth, found
/// without a reference. A round is two passes with the same numbers of samples and independent
/// seeds. With halves a and b of the mean m = (a + b) / 2, (a - b) / 2 has the mean 0 and the
/// variance of m, whatever happens between samples and pixels: it sees stratification and filters
/// as they are. What both halves have in common, as the blur of a filter, it does not see.

#include <span>
#include <vector>

#include "engine/sample_allocation.h"
#include "images/image.h"
#include "shade/shade.h"

namespace tessera {

/// Keeps relative errors of dark pixels finite, as relMSE of images/compare.h does.
inline constexpr double relative_floor = 0.01;

class RoundMean {
 public:
  /// `groups`: those of the images, whose channels are linear.
  explicit RoundMean(std::vector<const AovDefinition*> groups) : groups_(std::move(groups)) {}

  /// Adds a round whose passes `a` and `b` had `allocation` each. Rounds count by the inverse of
  /// their squared errors, one weight for the whole image: weights of each pixel's own would follow
  /// its noise, and the mean would not be that of the samples. Channels that must not be averaged
  /// are those of the pass that saw the nearest surface.
  void add(Image&& a, Image&& b, const SampleAllocation& allocation);

  bool empty() const { return rounds_ == 0; }
  int rounds() const { return rounds_; }
  const Image& image() const { return image_; }
  Image take_image() { return std::move(image_); }
  /// Mean over pixels and R, G, B of variance / (value^2 + relative_floor).
  double error_squared() const { return error_squared_; }
  /// What is known of the noise, from all rounds, the later ones counting for more; not smoothed.
  const PixelNoise& noise() const { return noise_; }
  /// Samples of each pixel, of all passes.
  std::span<const uint64_t> samples() const { return samples_; }
  double mean_samples() const;

 private:
  using Differences = std::vector<double>;  // [colour * pixels + pixel]

  void take_closest(Image& to, const Image& from) const;
  void average(Image& to, const Image& from, double share) const;
  double relative_error_squared(const Differences& differences, const Image& image) const;
  void update_noise(const Differences& differences, const SampleAllocation& allocation);

  std::vector<const AovDefinition*> groups_;
  Image image_;
  Differences differences_;
  PixelNoise noise_;
  std::vector<uint64_t> samples_;
  double error_squared_ = 0;
  int rounds_ = 0;
};

}  // namespace tessera
