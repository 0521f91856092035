#pragma once
/// Small functions shared by shaders and lights.

#include <algorithm>

#include <glm/glm.hpp>

namespace tessera {

inline constexpr float pi = 3.14159265358979323846f;

constexpr float radians(float degrees) { return degrees * (pi / 180.0f); }

/// 0 below `low`, 1 above `high`, smooth between; a step where the two coincide.
inline float smoothstep(float low, float high, float x) {
  if (!(high > low)) return x < low ? 0.0f : 1.0f;
  const float a = std::clamp((x - low) / (high - low), 0.0f, 1.0f);
  return a * a * (3.0f - 2.0f * a);
}

/// `v` / |v|, or zero for the zero vector.
inline glm::vec3 unit_or_zero(const glm::vec3& v) {
  const float length = glm::length(v);
  return length > 0.0f ? v / length : glm::vec3(0.0f);
}

}  // namespace tessera
