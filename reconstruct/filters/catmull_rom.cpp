#include "reconstruct/pixel_filter.h"

#include <cmath>

namespace tessera {
namespace {

// The interpolating cubic with support [-2, 2]; its width parameter only truncates it.
double weight(double x, double) {
  const double a = std::abs(x);
  if (a >= 2.0) return 0.0;
  if (a < 1.0) return 1.0 + a * a * (1.5 * a - 2.5);
  return 2.0 + a * (-4.0 + a * (2.5 - 0.5 * a));
}

}  // namespace

PixelFilterDefinition pixel_filter_catmull_rom() {
  return {"catmull-rom", "Catmull-Rom cubic, unscaled: cut off where the width ends", weight};
}

}  // namespace tessera
