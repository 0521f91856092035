#pragma once
/// Which frequencies of a grid's shading can be seen, and so how densely it has to be sampled
/// (Vaidyanathan et al. 2012, Adaptive Image Space Shading for Motion and Defocus Blur, sections
/// 3.1 and 3.2).
///
/// The image is the shading convolved with the lens profile scaled by the circle of confusion, the
/// shutter response stretched along the motion, and the pixel filter. The first and the last leave
/// a disc of radius
///
///   r = min(lens / min_coc, pixel).
///
/// A point that moves along the unit vector e, `speed` pixels per shutter, leaves the band
/// |f . e| <= shutter / speed. With o = shutter / min_speed, motion in all directions within theta
/// of e_mu leaves the union of the bands |f . e| <= o: an hourglass across e_mu. Its farthest
/// point along e_mu within the disc: at radius p > o, the point at angle a from e_mu lies in the
/// band of the direction at angle -theta if cos(a + theta) <= o / p, so the least such angle is
/// acos(o / p) - theta, where
///
///   f . e_mu = p cos(acos(o / p) - theta) = o cos(theta) + sqrt(p^2 - o^2) sin(theta),
///
/// which grows with p up to the rim of the disc; once theta >= acos(o / r), the hourglass holds
/// r e_mu itself. Hence
///
///   d_mu = 2 (o cos(theta) + sqrt(r^2 - o^2) sin(theta)) if o < r cos(theta), otherwise 2 r,
///   d_perp = 2 r.
///
/// (Equation 8 of the paper has r and a plus sign where o and a minus sign belong: without any
/// spread of directions it gives 2 r, whatever the speed.)

#include "shade/blur_bounds.h"

namespace tessera {

/// Frequencies that hold a stated share of the energy of each kernel; all positive.
struct BandLimits {
  double lens = 0.5;     ///< LensProfile::band_limit(), cycles per unit lens coordinate
  double shutter = 0.5;  ///< ShutterProfile::band_limit(), cycles per shutter
  double pixel = 0.5;    ///< of the pixel filter, cycles per pixel, at most 0.5
};

/// Box in frequency space that holds what of a grid's shading can be seen; full widths in cycles
/// per pixel (cells are 1 / d wide).
struct ShadingExtents {
  glm::vec2 direction{1, 0};  ///< e_mu, unit, raster
  float d_mu = 1;             ///< along `direction`
  float d_perp = 1;           ///< across it
};

/// Cells are never wider than this many pixels: more blur than fits any picture saves nothing, and
/// its frequencies come near to what a float can hold.
inline constexpr double widest_cell_pixels = 1 << 20;

/// The box for the blur of a grid. d_mu <= d_perp <= 2 * limits.pixel; both are at least
/// 1 / widest_cell_pixels (or 2 * limits.pixel, if that is less).
ShadingExtents shading_extents(const BlurBounds& bounds, const BandLimits& limits);

}  // namespace tessera
