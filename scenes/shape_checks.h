#pragma once
/// Checks of shapes as a scene file gives them: counts add up, indices are in range.

#include "base/diagnostics.h"
#include "scenes/geometry.h"

namespace tessera {

/// How many values of a primitive variable each storage class needs (constant needs 1).
struct PrimvarCounts {
  size_t uniform, varying, vertex, facevarying;

  size_t of(StorageClass storage) const;
};

/// See scenes/geometry.h. `control_points` is the number of points given. The shape is checked.
PrimvarCounts primvar_counts(const Shape& shape, size_t control_points);

/// Throws Error at `where` when the shape and its number of control points do not go together.
/// Repairs what the RenderMan Interface lets pass: z ranges beyond a sphere or torus are cut to it;
/// creases along edges the mesh does not have are dropped with a warning.
void check_shape(Shape& shape, size_t control_points, const SourceLocation& where,
                 Diagnostics& diagnostics);

/// Whether two shapes can be motion keys of one surface: all but points, sharpnesses and quadric
/// parameters are equal.
bool same_topology(const Shape& a, const Shape& b);

}  // namespace tessera
