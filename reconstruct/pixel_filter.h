#pragma once
/// Pixel filters: separable weights over the distance from a pixel's centre.

#include <span>
#include <string_view>

namespace tessera {

/// A kind of pixel filter, one file of reconstruct/filters/ each. The weight of a sample at offset
/// (x, y) from the pixel's centre is weight(x, x_width) * weight(y, y_width) within half the widths
/// and 0 beyond.
struct PixelFilterDefinition {
  const char* name;  ///< as the PixelFilter request names it
  const char* help;
  double (*weight)(double x, double full_width);  ///< |x| <= full_width / 2, pixels; symmetric
};

std::span<const PixelFilterDefinition> pixel_filter_registry();
/// Throws Error that lists the choices when unknown.
const PixelFilterDefinition& find_pixel_filter(std::string_view name);

}  // namespace tessera
