#pragma once
/// The named cubic bases of the RenderMan Interface.

#include <optional>
#include <string_view>

#include "scenes/geometry.h"

namespace tessera {

struct NamedBasis {
  PatchMesh::Basis matrix;
  int step;  ///< control points from one patch of a mesh to the next
};

/// "bezier", "b-spline", "catmull-rom", "hermite" or "power"; nothing for any other name.
std::optional<NamedBasis> named_basis(std::string_view name);

}  // namespace tessera
