#pragma once
/// Subdivision surfaces, Catmull-Clark and Loop, through OpenSubdiv's Bfr.
///
/// Faces with as many vertices as their scheme is made for are one patch each: quadrangles over
/// their own parameters, triangles with side 2 collapsed. Other Catmull-Clark faces are one patch a
/// corner, over the quarter between the corner, the middles of its edges and the centre.

#include <memory>

#include "dice/moving_points.h"
#include "dice/patch.h"

namespace tessera {

/// Topology and surface factory of a mesh; shared by all instances of a geometry. Thread safe.
class SubdivisionTopology;

/// `geometry` must hold a SubdivisionMesh. Throws Error when OpenSubdiv refuses the mesh.
std::shared_ptr<const SubdivisionTopology> make_subdivision_topology(const Geometry& geometry);

/// `surface` and `points` must outlive the set.
std::unique_ptr<PatchSet> make_subdivision_patches(
    const Surface& surface, const MovingPoints& points,
    std::shared_ptr<const SubdivisionTopology> topology);

}  // namespace tessera
