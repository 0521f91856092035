#pragma once
/// Polygon meshes: convex quadrangles become bilinear patches, everything else triangles.

#include <memory>
#include <vector>

#include "dice/moving_points.h"
#include "dice/patch.h"

namespace tessera {

/// How a polygon mesh is cut into patches; shared by all instances of a geometry.
struct PolygonTopology {
  struct Piece {
    int corner[4];  ///< indices into PolygonMesh::vertices, in the patch's corner order
    int polygon;
  };
  std::vector<Piece> pieces;
};

/// `geometry` must hold a PolygonMesh.
std::shared_ptr<const PolygonTopology> make_polygon_topology(const Geometry& geometry);

/// With `smooth_normals`, patches give the area-weighted mean normals of the mesh's vertices,
/// interpolated: the direction in which a displaced mesh stays closed. `surface` and `points` must
/// outlive the set.
std::unique_ptr<PatchSet> make_polygon_patches(const Surface& surface, const MovingPoints& points,
                                               std::shared_ptr<const PolygonTopology> topology,
                                               bool smooth_normals);

}  // namespace tessera
