#pragma once
/// Small functions shared by shaders and lights.

#include <algorithm>
#include <cmath>
#include <utility>

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

inline bool is_finite(const glm::vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// The normal `N` or its opposite, whichever does not point along `I` (faceforward of the RenderMan
/// Interface).
inline glm::vec3 turned_against(const glm::vec3& N, const glm::vec3& I) {
  return glm::dot(N, I) > 0.0f ? -N : N;
}

/// `v` / |v|, or zero for the zero vector and for what is no number. In double: squares of floats
/// of 1e20 and 1e-23 are none.
inline glm::vec3 unit_or_zero(const glm::vec3& v) {
  const double length = glm::length(glm::dvec3(v));
  return length > 0.0 && std::isfinite(length) ? glm::vec3(glm::dvec3(v) / length)
                                               : glm::vec3(0.0f);
}

/// Two unit vectors at right angles to the unit vector `n` and to each other (T. Duff et al.,
/// "Building an orthonormal basis, revisited", JCGT 2017).
inline std::pair<glm::dvec3, glm::dvec3> tangents(const glm::dvec3& n) {
  const double sign = std::copysign(1.0, n.z), a = -1.0 / (sign + n.z), b = n.x * n.y * a;
  return {{1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}};
}

/// The unit square onto the unit disc, area kept: squares about the middle become circles
/// (P. Shirley, K. Chiu, "A low distortion map between disk and square", JGT 1997).
inline glm::vec2 disc_from_square(const glm::vec2& xi) {
  const glm::vec2 at = 2.0f * xi - 1.0f;
  if (at == glm::vec2(0.0f)) return at;
  const bool across = std::abs(at.x) > std::abs(at.y);
  const float radius = across ? at.x : at.y;
  const float angle = across ? pi / 4.0f * (at.y / at.x) : pi / 2.0f - pi / 4.0f * (at.x / at.y);
  return radius * glm::vec2(std::cos(angle), std::sin(angle));
}

}  // namespace tessera
