#pragma once
/// A point of a grid, and how far a shading cell around it reaches.

#include <array>
#include <cstdint>

#include <glm/glm.hpp>

namespace tessera {

/// (1 - b1 - b2) A + b1 B + b2 C of a triangle (dice/grid.h).
struct SurfacePoint {
  uint32_t triangle = 0;
  float b1 = 0, b2 = 0;
  std::array<float, 3> weights() const { return {1.0f - b1 - b2, b1, b2}; }
};

/// The change of the grid's parameters, in micropolygons, over one cell along its x and its y axis.
struct CellFootprint {
  glm::vec2 ij_per_x{1, 0}, ij_per_y{0, 1};
};

}  // namespace tessera
