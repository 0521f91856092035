#pragma once
/// The maps of a camera as image files keep them.

#include <glm/glm.hpp>

#include "cameras/camera.h"

namespace tessera {

/// Maps from world space at shutter open, for column vectors. Normalised device coordinates (NDC),
/// after the divide, are (0, 0) at the upper left corner of the picture and (1, 1) at the lower
/// right one; their z is 0 at the near clipping plane and 1 at the far one.
struct CameraMatrices {
  glm::dmat4 camera_from_world{1.0};
  glm::dmat4 ndc_from_world{1.0};
};

CameraMatrices camera_matrices(const Camera& camera);

}  // namespace tessera
