#pragma once
/// The vertices of a grid in its shading space, and the sheets that it falls into there.

#include <vector>

#include "base/aligned.h"
#include "shade/surface_point.h"

namespace tessera {

/// Lattice coordinates, and the W that a point between vertices is weighted by: positions in the
/// plane are affine, those on the surface perspective.
struct SpaceVertices {
  int u_count = 1, v_count = 1;
  AlignedVector<float> x, y, w;

  int triangle_count() const { return 2 * u_count * v_count; }
};

/// Which sheet each triangle belongs to. Where a grid turns away from the eye, or folds, two parts
/// of it lie over one another in shading space; a cell must not mix them. A sheet is a connected
/// part whose triangles all turn the same way. If a grid also winds around so far that such a part
/// could meet itself, the sheets end at the borders of blocks of 8 x 8 micropolygons as well.
class SpaceCharts {
 public:
  SpaceCharts() = default;
  explicit SpaceCharts(const SpaceVertices& vertices);

  uint32_t of(uint32_t triangle) const { return chart_.empty() ? 0 : chart_[triangle]; }

 private:
  std::vector<uint32_t> chart_;  ///< [triangle]; empty: all one
};

}  // namespace tessera
