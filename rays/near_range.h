#pragma once
/// How far the surface that is seen may be from the coarser micropolygons that rays meet.

#include <vector>

#include "dice/grid.h"

namespace tessera {

/// A ray that starts on the surface of a micropolygon does not meet that micropolygon where this is
/// within `reach` of its origin and the origin within `height` of the plane of the triangle. So
/// what is met of one's own surface nearby is what rises steeply: a fold, or another face at an
/// edge.
struct NearRange {
  float height = 0;  ///< camera units
  float reach = 0;   ///< camera units
};

/// One a micropolygon, valid at every time of the shutter.
///
/// The surface over a segment e between vertices with unit normals m and n deviates from it by
/// |(n - m) . e| / 8 if it is quadratic, and so by an eighth of the second difference of positions;
/// over a triangle by 4/3 of the largest of its sides, and over the two triangles of a quadrangle
/// by its twist, |a - b - c + d| / 4. Details of a displacement that the vertices
/// miss show in the second differences that they leave. Normals do not count for polygons, which
/// are flat.
std::vector<NearRange> near_ranges(const Grid& grid);

}  // namespace tessera
