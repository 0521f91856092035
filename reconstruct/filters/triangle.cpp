#include "reconstruct/pixel_filter.h"

#include <cmath>

namespace tessera {
namespace {

double weight(double x, double full_width) { return 1.0 - std::abs(x) / (0.5 * full_width); }

}  // namespace

PixelFilterDefinition pixel_filter_triangle() { return {"triangle", "linear fall-off", weight}; }

}  // namespace tessera
