#include "shade/light_extent.h"

#include <cmath>

#include "base/error.h"

namespace tessera {
namespace {

void require_range(double area_root, const char* what) {
  // Floats hold the square root of any area whose places they hold apart from one another.
  if (area_root > 1e-18 && area_root < 1e18) return;
  throw Error(
      fmt::format("the transform in force gives it {} of {:g} camera units squared, expected "
                  "one between 1e-36 and 1e36",
                  what, area_root * area_root));
}

}  // namespace

double positive_size(const BoundParameters& parameters, const char* name) {
  const float size = parameters.scalar(name);
  if (size > 0.0f && std::isfinite(size)) return size;
  throw Error(fmt::format("\"{}\" is {}, expected a positive number", name, size));
}

LightExtent flat_extent(const glm::dvec2& half_lengths, double area_factor,
                        const glm::dmat4& camera_from_light) {
  const glm::dvec3 x(camera_from_light[0]), y(camera_from_light[1]), z(camera_from_light[2]);
  const glm::dvec3 a = half_lengths.x * x, b = half_lengths.y * y, across = glm::cross(a, b);
  const double area_root = std::sqrt(area_factor * glm::length(across));
  require_range(area_root, "an area");
  const double side = glm::dot(across, z) < 0.0 ? -1.0 : 1.0;
  LightExtent extent;
  extent.centre = glm::vec3(camera_from_light[3]);
  extent.half_axes = {glm::vec3(a), glm::vec3(b), glm::vec3(0.0f)};
  extent.normal = glm::vec3(side * glm::normalize(across));
  extent.area_root = float(area_root);
  return extent;
}

LightExtent ball_extent(double radius, const glm::dmat4& camera_from_light) {
  const glm::dmat3 axes = radius * glm::dmat3(camera_from_light);
  const double volume_root = std::cbrt(std::abs(glm::determinant(axes)));
  require_range(volume_root, "a cross section");
  LightExtent extent;
  extent.centre = glm::vec3(camera_from_light[3]);
  for (int axis = 0; axis < 3; ++axis) extent.half_axes[size_t(axis)] = glm::vec3(axes[axis]);
  extent.area_root = float(volume_root);
  extent.round = true;
  return extent;
}

}  // namespace tessera
