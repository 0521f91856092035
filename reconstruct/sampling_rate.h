#pragma once
/// How many samples a pixel needs before an axis-aligned filter can tell its image from the
/// replicas that sampling makes of it.

#include <span>

#include "reconstruct/method.h"

namespace tessera {

/// The wedges of one effect along the two image axes.
struct EffectWedges {
  AxisWedge x, y;
};

/// Samples a pixel by the sampling-rate bound of axis-aligned filtering. With coordinates in
/// [-1, 1] the pattern at |Omega_x| reaches up to |Omega_y| = d_max |Omega_x|, and the filter
/// passes |Omega_y| <= 4 (Wu et al. 2017, section 3, with half-width 1) and |Omega_x| <= min(pi, 4
/// / d_min) over the effects, pi being the pixels' own. Replicas lie pi apart for each sample along
/// an axis and must stay clear of what the filter passes: N >= (4 + d_max Omega_x) / pi for each
/// effect and axis, and the product of those. d_min is 0 for a wedge with both signs. An effect
/// whose wedge is {0, 0} is absent. At least 1, and finite: at most 1e6.
double samples_by_bound(std::span<const EffectWedges> effects);

}  // namespace tessera
