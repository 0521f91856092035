#include <algorithm>
#include <cmath>

#include "cameras/spectrum.h"
#include "shade/blur_bounds.h"
#include "shade/lattice_shading.h"
#include "shade/mode_arguments.h"

namespace tessera {
namespace {

/// Shares of energy that the cells must be able to carry: of the lens's, the shutter's and the
/// pixel filter's spectrum. docs/shading.md has the measurements that they come from.
struct Shares {
  double lens = 0.96, shutter = 0.98, filter = 0.98;
};

Shares read_shares(std::string_view arguments) {
  constexpr double not_given = -1;
  double all = not_given;
  Shares given{not_given, not_given, not_given};
  read_mode_arguments(
      "aas", arguments,
      {{"share", "share of energy, for all three", &all, 0, most_energy_share},
       {"lens", "share of the lens's energy", &given.lens, 0, most_energy_share},
       {"shutter", "share of the shutter's energy", &given.shutter, 0, most_energy_share},
       {"filter", "share of the pixel filter's energy", &given.filter, 0, most_energy_share}});
  Shares shares;
  for (double Shares::*share : {&Shares::lens, &Shares::shutter, &Shares::filter}) {
    if (all != not_given) shares.*share = all;
    if (given.*share != not_given) shares.*share = given.*share;
  }
  return shares;
}

/// Frequencies beyond half a cycle a pixel are not seen at all: pixels are where the film samples.
BandLimits band_limits(const ShadingFrame& frame, const Shares& shares) {
  const Camera& camera = frame.bindings->camera();
  BandLimits limits{};
  if (frame.lens) limits.lens = camera.lens_profile().band_limit(shares.lens);
  if (frame.motion) limits.shutter = camera.shutter_profile().band_limit(shares.shutter);
  limits.pixel = 0.5;
  if (frame.pixel_filter_band_limit)
    limits.pixel = std::min(0.5, frame.pixel_filter_band_limit(shares.filter));
  return limits;
}

}  // namespace

/// K. Vaidyanathan et al., "Adaptive image space shading for motion and defocus blur", HPG 2012.
ShadingModeDefinition shading_mode_aas() {
  return {
      "aas",
      "adaptive anisotropic shading: cells along the motion, as large as the blur allows (share=S,"
      " or lens=S, shutter=S, filter=S: shares of energy that cells can carry)",
      [](std::string_view arguments, const ShadingFrame& frame) -> std::unique_ptr<Shading> {
        const BandLimits limits = band_limits(frame, read_shares(arguments));
        const int per_edge = cells_per_edge(frame);
        return std::make_unique<LatticeShading>(frame, [=](const Grid& grid) {
          const BlurBounds blur =
              blur_bounds(grid, frame.bindings->camera(), frame.motion, frame.lens);
          ShadingExtents extents = shading_extents(blur, limits);
          // Cells as fine as pixels do best where pixels are: a pixel then sees one of them,
          // not parts of four.
          const bool sharp = extents.d_mu >= float(2 * limits.pixel);
          const float per_pixel = 1.0f / std::sqrt(grid.attributes().shading_rate);
          extents.d_mu *= per_pixel, extents.d_perp *= per_pixel;
          return ShadingSpaceSettings{extents, sharp ? LatticeAnchor::raster : LatticeAnchor::grid,
                                      per_edge};
        });
      }};
}

}  // namespace tessera
