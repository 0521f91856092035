#pragma once
/// The band of the coordinate that samples are spread over.

namespace tessera {

/// W, Omega_y_max of the MAAF paper (section 3): the highest frequency along y that matters, in
/// radians per unit of y. A light of half-width L is given the deviation L / 2 there, and its
/// spectrum ends at two deviations of its own, 2 * (2 / L); L = 1, as y runs over [-1, 1].
inline constexpr double light_band = 4.0;

}  // namespace tessera
