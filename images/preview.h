#pragma once
/// Linear images as 8-bit sRGB.

#include <cstdint>
#include <vector>

#include "images/image.h"

namespace tessera {

/// Interleaved 8-bit pixels of a data window, rows from the top.
struct Preview {
  int width = 0, height = 0;
  int channels = 3;  ///< 3: RGB; 4: RGB and alpha, not premultiplied
  std::vector<uint8_t> pixels;
};

/// sRGB code value (IEC 61966-2-1) of a linear value: clamped to [0, 1], rounded; NaN gives 0.
uint8_t srgb8_from_linear(float linear);

/// The linear value whose sRGB code value in [0, 1] is `code`.
float linear_from_srgb(float code);

/// R, G and B of `image` or, failing them, its first channel as grey. `keep_alpha` adds channel A
/// and divides colours by it; without it (or without A) pixels are as seen over black.
/// Throws Error for an image without channels.
Preview make_preview(const Image& image, bool keep_alpha = false);

}  // namespace tessera
