#include "shade/shading_extents.h"

#include <algorithm>
#include <cmath>

namespace tessera {
namespace {

/// Largest f . e_mu in the hourglass of bands of half width `band` within `theta` of e_mu, within
/// the disc of radius `r`.
double reach_along_motion(double r, double band, double theta) {
  if (band >= r * std::cos(theta)) return r;
  return std::min(r, band * std::cos(theta) + std::sqrt(r * r - band * band) * std::sin(theta));
}

}  // namespace

ShadingExtents shading_extents(const BlurBounds& bounds, const BandLimits& limits) {
  double r = limits.pixel;
  if (bounds.min_coc > 0.0f) r = std::min(r, limits.lens / double(bounds.min_coc));
  double along = r;
  if (bounds.min_speed > 0.0f)
    along = reach_along_motion(r, limits.shutter / double(bounds.min_speed),
                               double(bounds.half_span_radians));
  const auto width = [&](double half) {
    return float(std::min(std::max(2.0 * half, 1.0 / widest_cell_pixels), 2.0 * limits.pixel));
  };
  return {bounds.direction, width(along), width(r)};
}

}  // namespace tessera
