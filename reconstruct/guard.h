#pragma once
/// How much of each filtered image to take, so that filtering never does harm.

#include <vector>

#include "reconstruct/component.h"

namespace tessera {

/// For every candidate and pixel the share of its filtered value F in the best estimate, which is
/// y + sum of share * (F - y), y being the unfiltered value. With y = truth + noise of variance s2
/// and a share w of that noise in F, the expected squared error of y + a (F - y) is
///
///   s2 - 2 a (1 - w) s2 + a^2 (F - y)^2,  least for  a = (1 - w) s2 / (F - y)^2
///
/// (Stein's unbiased estimate for a linear filter), all summed over the 9 x 9 pixels around and the
/// three channels. As samples grow, s2 falls to 0 and with it the share of a filter that blurs too
/// much. Candidates share a pixel by the inverse squares of the errors that are expected of them.
/// The sums are noisy themselves, by a quarter of their size, and what the lower one lacks by
/// chance would let noise through: (F - y)^2 counts only as far as it exceeds (1 - w) s2 by more.
///
/// s2 is the lesser of two estimates, neither of which is too low on average: from two halves of
/// each pixel's samples, too high where samples are stratified, and from how much F - y differs
/// between neighbours, too high where F blurs details. Where the first is not known, as with one
/// sample a pixel, the second is all there is.
///
/// Pixels that are 0 in `shared` (or null) say nothing and get 0.
std::vector<std::vector<float>> filtered_shares(const Component& component,
                                                const NoiseCorrelation& correlation,
                                                const std::vector<float>* shared);

/// Pixels to either side whose values count.
inline constexpr int guard_reach = 5;

}  // namespace tessera
