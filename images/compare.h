#pragma once
/// How far one image is from another.

#include <string>
#include <vector>

#include "images/image.h"

namespace tessera {

/// Differences over all pixels of the channels two images share.
struct ImageDifference {
  double rmse = 0.0;     ///< root of the mean of (a - b)^2
  double rel_mse = 0.0;  ///< mean of (a - b)^2 / (b^2 + 0.01); b is the reference
  double psnr_db = 0.0;  ///< -20 log10(rmse), for a peak of 1; infinite when the images are equal
  double largest = 0.0;  ///< largest |a - b|, infinite where non-finite values differ
  int largest_x = 0, largest_y = 0;  ///< where: pixel, in display coordinates
  std::string largest_channel;       ///< where: channel; empty when the images are equal
  size_t values = 0;                 ///< pixels times channels compared
  /// Values that are NaN or infinite in one image and not the same in the other. They are left out
  /// of the means. Two NaNs, or two infinities of a sign, are the same.
  size_t nonfinite_mismatches = 0;
  std::vector<std::string> only_in_a, only_in_b;  ///< channels without a counterpart
};

/// Throws Error when the data windows differ or no channel is common.
ImageDifference compare_images(const Image& a, const Image& b);

}  // namespace tessera
