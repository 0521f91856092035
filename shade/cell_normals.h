#pragma once
/// The normals of a surface within a shading cell: their mean, their change, and the bumps between
/// vertices of the grid that a cell larger than micropolygons cannot show one by one (after M.
/// Olano, D. Baker, "LEAN mapping", I3D 2010, with the vertices of the grid in place of texels).

#include "shade/cell_points.h"

namespace tessera {

struct CellNormal {
  glm::vec3 N{0.0f};                 ///< unit mean, outward, camera space
  glm::vec3 dNdx{0.0f}, dNdy{0.0f};  ///< change over the cell along its axes
  float variance = 0.0f;             ///< ShadingPoints::normal_variance
};

/// Up to 8 x 8 vertices are looked at, spread over the cell's parallelogram as far as the grid
/// goes. In a cell about as small as a micropolygon, N is interpolated and its change that of the
/// three micropolygons around.
CellNormal cell_normal(const CellPoint& cell);

}  // namespace tessera
