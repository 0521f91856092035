#pragma once
/// Rectangles in raster space: pixels, x to the right, y down, pixel (i, j) covering [i, i+1) x [j, j+1).

#include <algorithm>
#include <limits>

namespace tessera {

/// Whole pixels [x0, x1) x [y0, y1).
struct PixelRect {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;

  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
  bool empty() const { return x1 <= x0 || y1 <= y0; }
  long pixel_count() const { return empty() ? 0 : long(width()) * height(); }
  bool contains(int x, int y) const { return x >= x0 && x < x1 && y >= y0 && y < y1; }
  PixelRect intersect(const PixelRect& o) const {
    return {std::max(x0, o.x0), std::max(y0, o.y0), std::min(x1, o.x1), std::min(y1, o.y1)};
  }
  PixelRect grown(int margin) const { return {x0 - margin, y0 - margin, x1 + margin, y1 + margin}; }
  bool operator==(const PixelRect&) const = default;
};

/// A closed box of raster positions in pixels; empty when min > max.
struct RasterBounds {
  float x_min = std::numeric_limits<float>::infinity();
  float y_min = std::numeric_limits<float>::infinity();
  float x_max = -std::numeric_limits<float>::infinity();
  float y_max = -std::numeric_limits<float>::infinity();

  bool empty() const { return !(x_min <= x_max && y_min <= y_max); }
  void add(float x, float y) {
    x_min = std::min(x_min, x), x_max = std::max(x_max, x);
    y_min = std::min(y_min, y), y_max = std::max(y_max, y);
  }
  void add(const RasterBounds& o) {
    x_min = std::min(x_min, o.x_min), x_max = std::max(x_max, o.x_max);
    y_min = std::min(y_min, o.y_min), y_max = std::max(y_max, o.y_max);
  }
  bool overlaps(const PixelRect& r) const {
    return x_max >= float(r.x0) && x_min <= float(r.x1) && y_max >= float(r.y0) &&
           y_min <= float(r.y1);
  }
  static RasterBounds everything() {
    const float inf = std::numeric_limits<float>::infinity();
    return {-inf, -inf, inf, inf};
  }
};

}  // namespace tessera
