#pragma once
/// How much of a filtered image to take, so that filtering never does harm.

#include <vector>

#include "reconstruct/component.h"

namespace tessera {

/// For every pixel the share a in [0, 1] of the filtered value F for which y + a (F - y) is expected
/// to lie nearest to the truth, y being the unfiltered value. With y = truth + noise of variance s2
/// and a share w of that noise in F, the expected squared error is
///
///   s2 + 2 a (w - 1) s2 + a^2 (F - y)^2,  least for  a = (1 - w) s2 / (F - y)^2
///
/// (Stein's unbiased estimate for a linear filter), both summed over the 7 x 7 pixels around and the
/// three channels. As samples grow, s2 falls to 0 and with it the share of a filter that blurs too
/// much. Where no variance is known the filtered value is trusted.
///
/// `scale` (or null) multiplies errors: planes as Component::plain. Pixels that are 0 in `shared`
/// (or null) say nothing and get 0.
std::vector<float> filtered_shares(const Component& component, const Planes* scale,
                                   const std::vector<float>* shared);

inline constexpr int guard_reach = 3;

}  // namespace tessera
