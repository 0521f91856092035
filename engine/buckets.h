#pragma once
/// The rectangle of pixels to render, cut into buckets.

#include "base/raster.h"

namespace tessera {

/// Bucket (i, j) starts at crop.x0 + i * size, crop.y0 + j * size; the last ones may be smaller.
struct BucketLayout {
  PixelRect crop;
  int size = 32;  ///< pixels

  int columns() const { return crop.empty() ? 0 : (crop.width() + size - 1) / size; }
  int rows() const { return crop.empty() ? 0 : (crop.height() + size - 1) / size; }
  int count() const { return columns() * rows(); }
  PixelRect rect(int i, int j) const {
    const int x = crop.x0 + i * size, y = crop.y0 + j * size;
    return PixelRect{x, y, x + size, y + size}.intersect(crop);
  }
};

}  // namespace tessera
