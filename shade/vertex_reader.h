#pragma once
/// Reads what the vertices of a grid hold at one shading cell.

#include <algorithm>
#include <array>

#include "shade/cell_points.h"

namespace tessera {

/// Reads values of a grid's vertices at one cell.
class VertexReader {
 public:
  explicit VertexReader(const CellPoint& cell)
      : corner_(cell.grid->triangle_corners(cell.at.triangle)),
        weight_(cell.at.weights()),
        footprint_(cell.footprint) {
    const Grid& grid = *cell.grid;
    const int m = int(cell.at.triangle / 2), row = grid.u_count + 1;
    const int i = m % grid.u_count, j = m / grid.u_count;
    // As wide as the differences that the footprint was made from (shade/shading_space.cpp).
    const int i0 = std::max(i - 1, 0), i1 = std::min(i + 2, grid.u_count);
    const int j0 = std::max(j - 1, 0), j1 = std::min(j + 2, grid.v_count);
    left_ = size_t(j * row + i0), right_ = size_t(j * row + i1);
    below_ = size_t(j0 * row + i), above_ = size_t(j1 * row + i);
    per_i_ = 1.0f / float(i1 - i0), per_j_ = 1.0f / float(j1 - j0);
  }

  float value(const float* f) const {
    return weight_[0] * f[corner_[0]] + weight_[1] * f[corner_[1]] + weight_[2] * f[corner_[2]];
  }
  /// The change of `f` over the cell along its x and y axes.
  glm::vec2 change(const float* f) const {
    const float di = (f[right_] - f[left_]) * per_i_, dj = (f[above_] - f[below_]) * per_j_;
    return {di * footprint_.ij_per_x.x + dj * footprint_.ij_per_x.y,
            di * footprint_.ij_per_y.x + dj * footprint_.ij_per_y.y};
  }

 private:
  std::array<int, 3> corner_;
  std::array<float, 3> weight_;
  CellFootprint footprint_;
  size_t left_, right_, below_, above_;
  float per_i_, per_j_;
};

}  // namespace tessera
