#pragma once
/// Latitude-longitude pictures of all directions.

#include <algorithm>
#include <cmath>

#include "shade/mathematics.h"

namespace tessera {

/// Where the unit direction `d` lies in such a picture, (s, t) in [0, 1]^2: z is up, and longitude
/// 0, in the middle, is +x.
inline glm::vec2 st_of_direction(const glm::vec3& d) {
  return {0.5f - std::atan2(d.y, d.x) / (2.0f * pi), std::acos(std::clamp(d.z, -1.0f, 1.0f)) / pi};
}

}  // namespace tessera
