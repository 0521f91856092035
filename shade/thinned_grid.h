#pragma once
/// Every so many vertices of a grid, for what varies slowly over it.

#include <span>
#include <vector>

#include "dice/grid.h"

namespace tessera {

/// A grid of the vertices in every `step`-th row and column of another, its first and last ones
/// among them: the outline is kept. Vertices, normals, parameters and primitive variables are
/// copied, for the first key alone; no bounds, no attachment. `grid` need not outlive it.
class ThinnedGrid {
 public:
  ThinnedGrid(const Grid& grid, int step);
  const Grid& grid() const { return thin_; }

  /// Values at all vertices of the original from those at the vertices of grid(), bilinear in the
  /// numbers of rows and columns; equal where the vertex was kept.
  std::vector<glm::vec3> spread(std::span<const glm::vec3> values) const;

 private:
  Grid thin_;
  std::vector<int> columns_, rows_;  ///< of the original, ascending, that were kept
};

}  // namespace tessera
