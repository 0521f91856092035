#pragma once
/// Finds points of a grid in its shading space.

#include <span>
#include <vector>

#include "shade/space_charts.h"

namespace tessera {

/// Bins of micropolygons over shading space. Refers to vertices and charts, which must outlive it.
class SpaceIndex {
 public:
  SpaceIndex(const SpaceVertices& vertices, const SpaceCharts& charts);

  /// The point of the chart at (x, y); if it has none there, the one nearest to (x, y) among its
  /// triangles that may touch the square of half width `reach` around it; if none does, the nearest
  /// of all. Of several, always the same one.
  SurfacePoint nearest(uint32_t chart, float x, float y, float reach) const;

 private:
  struct Best;

  void choose_bins();
  bool fill_bins();
  int column_of(float x) const;
  int row_of(float y) const;
  std::span<const uint32_t> bin(int column, int row) const;
  bool covers(uint32_t triangle, float x, float y, SurfacePoint& point) const;
  void consider_edges(uint32_t triangle, float x, float y, Best& best) const;

  const SpaceVertices& vertices_;
  const SpaceCharts& charts_;
  float x0_ = 0, y0_ = 0, x1_ = 0, y1_ = 0;  ///< bounds of the vertices
  float columns_per_x_ = 0, rows_per_y_ = 0;
  int columns_ = 1, rows_ = 1;
  std::vector<uint32_t> first_;          ///< [bin] into micropolygons_; one past the end last
  std::vector<uint32_t> micropolygons_;  ///< ascending within a bin
};

}  // namespace tessera
