#pragma once
/// What a fragment shows: values of its grid at the fragment's barycentrics and time.

#include <array>

#include "shade/shade.h"

namespace tessera {

/// The keys of a grid that a shutter time lies between: a value is that of `before` plus `share`,
/// in [0, 1), times the difference to `after`. At the time of a key it is that key's.
struct KeyBlend {
  int before = 0, after = 0;
  float share = 0.0f;

  KeyBlend(const Grid& grid, float t);
};

/// Camera-space position of a vertex between keys.
inline glm::vec3 vertex_camera(const Grid& grid, int vertex, const KeyBlend& at) {
  glm::vec3 P;
  for (int axis = 0; axis < 3; ++axis) {
    const float p0 = grid.P(at.before, axis)[vertex];
    P[axis] = at.share == 0.0f ? p0 : p0 + at.share * (grid.P(at.after, axis)[vertex] - p0);
  }
  return P;
}

/// A fragment resolved to the vertices it lies between.
struct FragmentGeometry {
  const Grid* grid = nullptr;
  std::array<int, 3> corner{};    ///< vertices A, B, C of its triangle (dice/grid.h)
  std::array<float, 3> weight{};  ///< barycentric weights of A, B, C
  float time = 0.0f;              ///< shutter time it was seen at

  FragmentGeometry(const ShadeInput& input, size_t fragment);

  /// A vertex array of the grid, interpolated.
  float interpolate(const float* values) const {
    return weight[0] * values[corner[0]] + weight[1] * values[corner[1]] +
           weight[2] * values[corner[2]];
  }
  /// Camera-space position at shutter time t.
  glm::vec3 P_camera(float t) const;
};

/// The interpolated unit normal at shutter open, camera space; zero where there is none.
glm::vec3 unit_normal(const FragmentGeometry& seen);

/// The pixel of the frame that a fragment was seen in.
inline glm::ivec2 pixel_of(const ShadeInput& input, size_t fragment) {
  const PixelRect& rect = input.samples->rect;
  const int in_bucket = int(input.fragments->sample[fragment]) / input.samples->samples_per_pixel;
  return {rect.x0 + in_bucket % rect.width(), rect.y0 + in_bucket / rect.width()};
}

}  // namespace tessera
