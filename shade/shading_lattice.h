#pragma once
/// The cells of a shading space: an affine map from the raster to lattice coordinates, in which
/// cell (i, j) is the unit square from (i, j).

#include <glm/glm.hpp>

#include "shade/shading_extents.h"

namespace tessera {

struct ShadingLattice {
  glm::dvec2 x_axis{1, 0}, y_axis{0, 1};  ///< lattice units per pixel
  glm::dvec2 offset{0, 0};                ///< lattice coordinates of raster (0, 0)

  glm::dvec2 from_raster(const glm::dvec2& raster) const {
    return {glm::dot(x_axis, raster) + offset.x, glm::dot(y_axis, raster) + offset.y};
  }
  glm::dvec2 raster_from(const glm::dvec2& lattice) const {
    const glm::dvec2 q = lattice - offset;
    const double determinant = x_axis.x * y_axis.y - x_axis.y * y_axis.x;
    return glm::dvec2(q.x * y_axis.y - q.y * x_axis.y, q.y * x_axis.x - q.x * y_axis.x) /
           determinant;
  }
};

/// Where a lattice begins.
enum class LatticeAnchor {
  raster,  ///< cells lie the same way in every grid: those of `extents` from raster (0, 0) on
  grid  ///< a whole number of cells, none larger than `extents` ask for, spans the grid, along it
        ///< if they are square: its rim cuts fewer of them
};

}  // namespace tessera
