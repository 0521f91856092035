#include "dice/flatness.h"

#include <algorithm>
#include <cmath>

namespace tessera {

namespace {

/// Of the largest coordinate: more than rounding moves the points by.
constexpr double off_plane = 1e-6;

template <class Measure>
glm::dvec3 farthest(const std::vector<glm::vec3>& points, const Measure& measure) {
  return *std::ranges::max_element(points, {}, [&](const glm::vec3& p) { return measure(p); });
}

/// Whether all the points are near a plane through three of them that are far apart.
bool in_a_plane(const std::vector<glm::vec3>& points) {
  if (points.empty()) return true;
  const glm::dvec3 first = points.front();
  const auto along = farthest(points, [&](const glm::dvec3& p) { return glm::length(p - first); });
  const glm::dvec3 line = along - first;
  const auto across = farthest(
      points, [&](const glm::dvec3& p) { return glm::length(glm::cross(line, p - first)); });
  const glm::dvec3 normal = glm::cross(line, across - first);
  const double length = glm::length(normal);
  if (!(length > 0)) return true;
  double off = 0, largest = 0;
  for (const glm::dvec3 p : points) {
    off = std::max(off, std::abs(glm::dot(normal, p - first)) / length);
    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  }
  return off <= off_plane * largest;
}

}  // namespace

bool is_flat(const SurfaceContext& context) {
  if (context.displacer) return false;
  std::vector<glm::vec3> hull;
  for (uint32_t p = 0; p < context.patches->patch_count(); ++p) {
    const std::unique_ptr<Patch> patch = context.patches->patch(p);
    for (int key = 0; patch && key < context.rate.key_count(); ++key) {
      hull.clear();
      patch->append_hull(key, ParameterRect{}, hull);
      if (!in_a_plane(hull)) return false;
    }
  }
  return true;
}

}  // namespace tessera
