#pragma once
/// The rectangle of pixels to sample, cut into buckets.

#include "base/raster.h"

namespace tessera {

/// Bucket (i, j) starts at sampled.x0 + i * size, sampled.y0 + j * size; the last ones may be
/// smaller.
struct BucketLayout {
  PixelRect sampled;
  int size = 32;  ///< pixels

  int columns() const { return sampled.empty() ? 0 : (sampled.width() + size - 1) / size; }
  int rows() const { return sampled.empty() ? 0 : (sampled.height() + size - 1) / size; }
  int count() const { return columns() * rows(); }
  PixelRect rect(int i, int j) const {
    const int x = sampled.x0 + i * size, y = sampled.y0 + j * size;
    return PixelRect{x, y, x + size, y + size}.intersect(sampled);
  }
};

}  // namespace tessera
