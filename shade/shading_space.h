#pragma once
/// The shading space of a grid: where its points lie on the raster at shutter open, seen through
/// the lens centre, cut into cells (K. Vaidyanathan et al., "Adaptive image space shading for
/// motion and defocus blur", HPG 2012, sections 3 and 3.4). Every sample of a surface point,
/// whenever and through whatever part of the lens it was seen, maps to the same place here: from
/// the point itself rather than from a velocity, so the map is exact.
///
/// A grid that is not wholly in front of the camera plane at shutter open has no such place. Its
/// space is then its own parameters, some cells to a micropolygon (`parametric()`).

#include <optional>

#include "cameras/camera.h"
#include "shade/shading_lattice.h"
#include "shade/space_charts.h"
#include "shade/space_index.h"
#include "shade/surface_point.h"

namespace tessera {

/// A cell of one sheet of a grid.
struct ShadingCell {
  uint32_t chart = 0;
  int x = 0, y = 0;

  static constexpr int most = 1 << 22;  ///< x and y stay below
  uint64_t key() const { return (uint64_t(chart) << 46) | (uint64_t(x) << 23) | uint64_t(y); }
};

struct ShadingSpaceSettings {
  ShadingExtents extents;
  LatticeAnchor anchor = LatticeAnchor::raster;
  int cells_per_edge =
      1;  ///< of a micropolygon, along u and along v, where the space is parametric
};

class ShadingSpace {
 public:
  /// The grid must outlive the space.
  ShadingSpace(const Grid& grid, const Camera& camera, const ShadingSpaceSettings& settings);
  ShadingSpace(const ShadingSpace&) = delete;  // the index refers to other members
  ShadingSpace& operator=(const ShadingSpace&) = delete;

  bool parametric() const { return parametric_; }
  /// Lattice coordinates of a point.
  glm::vec2 at(const SurfacePoint& point) const;
  ShadingCell cell_of(const SurfacePoint& point) const;
  /// The point of the cell's sheet nearest the cell's centre. Needs prepare_search().
  SurfacePoint shading_point(const ShadingCell& cell) const;
  /// The cell of the lattice over a raster position, whether the grid reaches there or not. Only
  /// where the space is not parametric.
  glm::ivec2 cell_over(const glm::vec2& raster) const;
  CellFootprint footprint(const SurfacePoint& point) const;
  /// Raster position of a point at shutter open. Only where the space is not parametric.
  glm::vec2 raster_of(const SurfacePoint& point) const;
  /// Makes shading_point() work; not at once with any other call.
  void prepare_search();

 private:
  bool place_vertices(const Camera& camera, const ShadingSpaceSettings& settings);
  bool fit_lattice(const ShadingSpaceSettings& settings);
  glm::dvec2 mean_u_direction() const;
  void place_parameters(int cells_per_edge);

  const Grid& grid_;
  ShadingLattice lattice_;
  SpaceVertices vertices_;
  SpaceCharts charts_;
  std::optional<SpaceIndex> index_;
  int x_cells_ = 1, y_cells_ = 1;
  bool parametric_ = false;
};

}  // namespace tessera
