#pragma once
/// Pixels that one bright sample lights far beyond all others near them.

#include <vector>

namespace tessera {

/// Finds pixels whose value is nearly all from one half of their samples and over a thousand times
/// the mean around them (the 11 x 11 pixels around without those that may hold the same samples:
/// `spread` pixels to either side), or over a million times the mean of those around that are less
/// than a ten thousandth of it, where most are. Filters do not share such pixels: their light
/// would light up everything in reach, and stays where it is instead. Returns 1 for pixels to
/// share, 0 for outliers. `value` and `even_part` (the part that even samples have) are planes of
/// `width` by `height` pixels.
std::vector<float> shared_pixels(const std::vector<float>& value,
                                 const std::vector<float>& even_part, int width, int height,
                                 int spread);

inline constexpr int outlier_reach = 5;

}  // namespace tessera
