#include "reconstruct/pixel_filter.h"

#include <cmath>

namespace tessera {
namespace {

double weight(double x, double full_width) {
  const double a = std::abs(4.0 * x / full_width);
  if (a >= 2.0) return 0.0;
  if (a < 1.0) return (16.0 + a * a * (21.0 * a - 36.0)) / 18.0;
  return (32.0 + a * (-60.0 + a * (36.0 - 7.0 * a))) / 18.0;
}

}  // namespace

PixelFilterDefinition pixel_filter_mitchell() {
  return {"mitchell", "Mitchell-Netravali cubic with B = C = 1/3, scaled to the width", weight};
}

}  // namespace tessera
