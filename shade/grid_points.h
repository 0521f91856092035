#pragma once
/// The vertices of a grid as a batch of shading points.

#include "cameras/camera.h"
#include "dice/grid.h"
#include "shade/points.h"

namespace tessera {

enum class Footprints { none, over_micropolygons };

/// Owns what a grid does not already hold. The grid must outlive it.
class GridPoints {
 public:
  GridPoints(const Grid& grid, const Camera& camera, Footprints footprints);
  GridPoints(const GridPoints&) = delete;
  GridPoints& operator=(const GridPoints&) = delete;

  const ShadingPoints& points() const { return points_; }

 private:
  void fill_incident(const Grid& grid, const Camera& camera);
  void fill_footprints(const Grid& grid);

  ShadingPoints points_;
  Vec3Array I_, dPdu_, dPdv_, dNdu_, dNdv_;
  AlignedVector<float> st_differences_;  ///< [dsdu, dtdu, dsdv, dtdv][vertex]
  std::vector<int32_t> surface_;
};

/// The change of `f` (one value a vertex) over one micropolygon along u and along v: central
/// differences inside, one-sided ones on the rim.
void grid_differences(const Grid& grid, const float* f, float* along_u, float* along_v);

}  // namespace tessera
