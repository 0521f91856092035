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

/// Radius in cycles per pixel within which `energy_share` of the power spectrum of the
/// two-dimensional filter lies; widths in pixels. Throws Error unless energy_share is in
/// (0, 0.9999] and the widths are positive and finite.
double pixel_filter_band_limit(const PixelFilterDefinition& filter, double x_width, double y_width,
                               double energy_share);

}  // namespace tessera
