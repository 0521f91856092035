#pragma once
/// Control points in the three forms a scene may give them.

#include <vector>

#include <glm/glm.hpp>

#include "scenes/geometry.h"

namespace tessera {

struct ControlPoints {
  std::vector<glm::vec3> P;
  std::vector<float> weights;  ///< empty when all are equal
};

/// Reads "P" (points), "Pw" (homogeneous points, divided by w; w must be positive) or, on patch
/// meshes, "Pz" (heights over the unit square, control points evenly spaced in it) from
/// `parameters`. Throws Error at `where` when there is none or it is of the wrong type.
ControlPoints take_control_points(const std::vector<Parameter>& parameters, const Shape& shape,
                                  const SourceLocation& where);

}  // namespace tessera
