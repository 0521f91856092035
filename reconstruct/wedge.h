#pragma once
/// The range of shifts that the surfaces near a pixel show, made safe for formulas.

#include <algorithm>
#include <cmath>

#include "reconstruct/method.h"

namespace tessera {

/// Ordered, within [-limit, limit], NaN counted as no shift.
inline AxisWedge bounded_wedge(const AxisWedge& wedge, float limit) {
  const auto bounded = [limit](float shift) {
    return std::isnan(shift) ? 0.0f : std::clamp(shift, -limit, limit);
  };
  const float a = bounded(wedge.low), b = bounded(wedge.high);
  return {std::min(a, b), std::max(a, b)};
}

/// The wedge turned so that `high` is the shift of larger size and not negative. Seen through
/// y -> -y a wedge [low, high] is [-high, -low].
struct TurnedWedge {
  double low = 0, high = 0;
  bool mirrored = false;  ///< the original is this one through y -> -y
};
inline TurnedWedge turned_wedge(const AxisWedge& wedge) {
  const bool mirrored = -wedge.low > wedge.high;
  if (mirrored) return {-double(wedge.high), -double(wedge.low), true};
  return {wedge.low, wedge.high, false};
}

/// Pixels: the size of the smallest shift, s_min of the paper; 0 where the wedge holds 0.
inline double smallest_shift(const AxisWedge& wedge) {
  return std::max(0.0, turned_wedge(wedge).low);
}

}  // namespace tessera
