#pragma once
/// Directions from the eye, camera space.

#include "cameras/camera.h"
#include "shade/mathematics.h"

namespace tessera {

/// Along the view that meets P, of any length: from the eye, or forward where all views are
/// parallel. Zero for P in the eye.
inline glm::vec3 along_view(const Camera& camera, const glm::vec3& P) {
  return camera.perspective() ? P : glm::vec3(0.0f, 0.0f, 1.0f);
}

/// The unit direction of the view that meets P; forward for P in the eye.
inline glm::vec3 view_direction(const Camera& camera, const glm::vec3& P) {
  const glm::vec3 I = unit_or_zero(along_view(camera, P));
  return I == glm::vec3(0.0f) ? glm::vec3(0.0f, 0.0f, 1.0f) : I;
}

}  // namespace tessera
