#pragma once
/// SIMD bounds of a grid's vertices at one key.

#include <cstddef>

#include "base/raster.h"
#include "cameras/camera.h"

namespace tessera {

struct VertexBounds {
  RasterBounds raster;  ///< through the whole lens; meaningless unless in_front
  float z_min = std::numeric_limits<float>::infinity();
  float z_max = -std::numeric_limits<float>::infinity();
  bool in_front = true;  ///< every vertex has W > 0
  bool finite = true;    ///< every coordinate is a finite number
};

/// Widens `bounds` by camera-space points given as separate runs, padded. `lens_extent` is the
/// largest lens coordinate, 0 for a pinhole.
void add_vertex_bounds(const RasterClipMap& map, float lens_extent, const float* x, const float* y,
                       const float* z, size_t count, VertexBounds& bounds);

}  // namespace tessera
