#include "reconstruct/pixel_filter.h"

#include <cmath>
#include <numbers>

namespace tessera {
namespace {

double weight(double x, double) {
  if (x == 0.0) return 1.0;
  return std::sin(std::numbers::pi * x) / (std::numbers::pi * x);
}

}  // namespace

PixelFilterDefinition pixel_filter_sinc() {
  return {"sinc", "sin(pi x) / (pi x), cut off where the width ends", weight};
}

}  // namespace tessera
