#pragma once
/// Depth maps made by ray casting in double precision, for the tests of shadows.

#include <cmath>
#include <functional>
#include <limits>

#include "images/image.h"
#include "shade/shadow_map.h"

namespace tessera::test {

/// Camera that looks along +z from `eye` in a world with the same axes; raster y is down.
struct MapCamera {
  glm::dvec3 eye{0.0};
  bool perspective = true;
  double half_width = 1.0;  ///< tangent of half the field of view, or half the width
  int size = 64;            ///< texels along a side

  glm::dvec3 origin(double x, double y) const {
    if (perspective) return eye;
    return eye + glm::dvec3(screen_x(x), screen_y(y), 0.0);
  }
  glm::dvec3 direction(double x, double y) const {
    return perspective ? glm::dvec3(screen_x(x), screen_y(y), 1.0) : glm::dvec3(0.0, 0.0, 1.0);
  }
  double screen_x(double x) const { return half_width * (2.0 * x / size - 1.0); }
  double screen_y(double y) const { return half_width * (1.0 - 2.0 * y / size); }

  /// As OpenEXR keeps them, for row vectors.
  std::array<float, 16> world_to_camera() const {
    return {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, float(-eye.x), float(-eye.y), float(-eye.z), 1};
  }
  /// x_ndc = (1 + x / (half_width w)) / 2, y_ndc = (1 - y / (half_width w)) / 2 in camera space,
  /// with w = z or 1; written out for a camera that is only shifted.
  std::array<float, 16> world_to_ndc() const {
    const double a = 0.5 / half_width;
    const glm::dvec3 e = eye;
    if (perspective) {
      return {float(a),
              0,
              0,
              0,
              0,
              float(-a),
              0,
              0,
              0.5f,
              0.5f,
              1,
              1,
              float(-a * e.x - 0.5 * e.z),
              float(a * e.y - 0.5 * e.z),
              float(-e.z),
              float(-e.z)};
    }
    return {float(a),
            0,
            0,
            0,
            0,
            float(-a),
            0,
            0,
            0,
            0,
            1,
            0,
            float(0.5 - a * e.x),
            float(0.5 + a * e.y),
            float(-e.z),
            1};
  }
};

/// Ray parameter of the nearest hit; infinite without one.
using Trace = std::function<double(const glm::dvec3& origin, const glm::dvec3& direction)>;
inline constexpr double no_hit = std::numeric_limits<double>::infinity();

/// One ray through the centre of each texel. Directions have z = 1, so the parameter is depth.
inline Image depth_image(const MapCamera& camera, const Trace& trace) {
  Image image(camera.size, camera.size);
  Image::Channel& depth = image.add_channel("Z");
  for (int y = 0; y < camera.size; ++y) {
    for (int x = 0; x < camera.size; ++x) {
      const double z = trace(camera.origin(x + 0.5, y + 0.5), camera.direction(x + 0.5, y + 0.5));
      depth.values[image.index(x, y)] = z < 1e37 ? float(z) : 1e38f;
    }
  }
  image.matrices["worldToCamera"] = camera.world_to_camera();
  image.matrices["worldToNDC"] = camera.world_to_ndc();
  return image;
}

inline double hit_sphere(const glm::dvec3& o, const glm::dvec3& d, const glm::dvec3& centre,
                         double radius) {
  const glm::dvec3 m = o - centre;
  const double a = glm::dot(d, d), b = glm::dot(m, d), c = glm::dot(m, m) - radius * radius;
  const double discriminant = b * b - a * c;
  if (discriminant < 0.0) return no_hit;
  for (const double root :
       {(-b - std::sqrt(discriminant)) / a, (-b + std::sqrt(discriminant)) / a}) {
    if (root > 1e-9) return root;
  }
  return no_hit;
}

inline double hit_plane(const glm::dvec3& o, const glm::dvec3& d, const glm::dvec3& point,
                        const glm::dvec3& normal) {
  const double t = glm::dot(point - o, normal) / glm::dot(d, normal);
  return t > 1e-9 ? t : no_hit;
}

}  // namespace tessera::test
