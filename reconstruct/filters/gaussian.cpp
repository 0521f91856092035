#include "reconstruct/pixel_filter.h"

#include <cmath>

namespace tessera {
namespace {

double weight(double x, double full_width) {
  const double r = 2.0 * x / full_width;
  return std::exp(-2.0 * r * r);
}

}  // namespace

PixelFilterDefinition pixel_filter_gaussian() {
  return {"gaussian", "exp(-2 r^2), r = 1 at half the width", weight};
}

}  // namespace tessera
