#include "reconstruct/pixel_filter.h"

namespace tessera {
namespace {

double weight(double, double) { return 1.0; }

}  // namespace

PixelFilterDefinition pixel_filter_box() { return {"box", "constant over its width", weight}; }

}  // namespace tessera
