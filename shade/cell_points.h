#pragma once
/// Points anywhere on the grids of one surface as a batch of shading points.

#include <span>
#include <vector>

#include "cameras/camera.h"
#include "dice/grid.h"
#include "shade/points.h"
#include "shade/surface_point.h"

namespace tessera {

/// A point to be shaded, and the cell that it stands for.
struct CellPoint {
  const Grid* grid = nullptr;
  SurfacePoint at;
  CellFootprint footprint;
};

/// Values interpolated between vertices at shutter open, with the footprints of the cells' axes.
class CellPoints {
 public:
  /// All grids are of one surface; they must outlive the object.
  CellPoints(std::span<const CellPoint> cells, const Camera& camera);
  CellPoints(const CellPoints&) = delete;
  CellPoints& operator=(const CellPoints&) = delete;

  const ShadingPoints& points() const { return points_; }

 private:
  void fill_geometry(std::span<const CellPoint> cells, const Camera& camera);
  void fill_parameters(std::span<const CellPoint> cells);
  void fill_primvars(std::span<const CellPoint> cells);

  ShadingPoints points_;
  Vec3Array P_, N_, I_, dPdx_, dPdy_, dNdx_, dNdy_;
  AlignedVector<float> normal_variance_;
  AlignedVector<float> parameters_;  ///< [u, v, s, t, dsdx, dtdx, dsdy, dtdy][point]
  std::vector<AlignedVector<float>> primvars_;
  std::vector<int32_t> surface_;
};

}  // namespace tessera
