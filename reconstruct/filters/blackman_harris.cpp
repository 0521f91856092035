#include "reconstruct/pixel_filter.h"

#include <cmath>
#include <numbers>

namespace tessera {
namespace {

double weight(double x, double full_width) {
  const double turn = 2.0 * std::numbers::pi * (x / full_width + 0.5);
  return 0.35875 - 0.48829 * std::cos(turn) + 0.14128 * std::cos(2 * turn) -
         0.01168 * std::cos(3 * turn);
}

}  // namespace

PixelFilterDefinition pixel_filter_blackman_harris() {
  return {"blackman-harris", "four-term Blackman-Harris window over the width", weight};
}

}  // namespace tessera
