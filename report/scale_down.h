#pragma once
/// Images of a size that a page can hold many of.

#include <span>
#include <string>

#include "images/image.h"

namespace tessera {

/// Pixels that the longer side of an image in a page may have. Of 1920 x 1080 half a size is left:
/// some twenty images rather than five in the room that a page has for them.
inline constexpr int largest_report_side = 1280;

/// The least number of pixels whose means, n x n of them each, fit `largest_report_side`; 1 for an
/// image that fits as it is.
int report_reduction(const Image& image);

/// Channels `names` of `image`, those that it has, each pixel the mean of `n` x `n` of them, fewer
/// at the right and bottom edges. Means, as pixels of the page then have the light of those they
/// stand for; whole numbers, as each then stands for as many. What is NaN or infinite makes the
/// mean so.
Image scaled_down(const Image& image, int n, std::span<const std::string> names);

}  // namespace tessera
