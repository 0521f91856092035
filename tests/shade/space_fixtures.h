#pragma once
// Grids in shading space, and what is known of them without it.

#include <cmath>
#include <random>
#include <vector>

#include "shade/shading_space.h"
#include "tests/shade/fixtures.h"

namespace tessera::test {

/// Camera-space position at shutter open, in double.
inline glm::dvec3 position(const Grid& grid, const SurfacePoint& point) {
  const auto corners = grid.triangle_corners(point.triangle);
  const double weights[] = {1.0 - double(point.b1) - double(point.b2), double(point.b1),
                            double(point.b2)};
  glm::dvec3 P(0.0);
  for (size_t k = 0; k < 3; ++k)
    for (int axis = 0; axis < 3; ++axis)
      P[axis] += weights[k] * double(grid.P(0, axis)[corners[k]]);
  return P;
}

/// Raster position seen by the camera of TestScene: 90 degrees over 100 x 100 pixels, y down.
inline glm::dvec2 raster_of(const Grid& grid, const SurfacePoint& point) {
  const glm::dvec3 P = position(grid, point);
  return {50.0 + 50.0 * P.x / P.z, 50.0 - 50.0 * P.y / P.z};
}

/// Points of all triangles, (n + 1) (n + 2) / 2 each, those on edges and corners included.
inline std::vector<SurfacePoint> dense_points(const Grid& grid, int n) {
  std::vector<SurfacePoint> points;
  for (uint32_t triangle = 0; triangle < 2 * uint32_t(grid.micropolygon_count()); ++triangle)
    for (int i = 0; i <= n; ++i)
      for (int j = 0; i + j <= n; ++j)
        points.push_back({triangle, float(i) / float(n), float(j) / float(n)});
  return points;
}

/// Points strictly inside triangles, where there is no doubt which one they belong to.
inline std::vector<SurfacePoint> inner_points(const Grid& grid, int per_triangle) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> uniform(0.01f, 0.98f);
  std::vector<SurfacePoint> points;
  for (uint32_t triangle = 0; triangle < 2 * uint32_t(grid.micropolygon_count()); ++triangle)
    for (int k = 0; k < per_triangle; ++k) {
      float a = uniform(random), b = uniform(random);
      if (a + b > 0.99f) a = 0.99f - a, b = 0.99f - b;
      points.push_back({triangle, std::abs(a), std::abs(b)});
    }
  return points;
}

inline int column_of(const Grid& grid, const SurfacePoint& p) {
  return int(p.triangle / 2) % grid.u_count;
}

inline bool inside_triangle(const SurfacePoint& p) {
  const float least = -1e-5f;
  return p.b1 >= least && p.b2 >= least && p.b1 + p.b2 <= 1.0f - least;
}

inline ShadingSpaceSettings raster_cells(float per_pixel = 1.0f) {
  return {{{1, 0}, per_pixel, per_pixel}, LatticeAnchor::raster, 1};
}
inline ShadingSpaceSettings grid_cells(float direction_radians, float d_mu, float d_perp) {
  return {{{std::cos(direction_radians), std::sin(direction_radians)}, d_mu, d_perp},
          LatticeAnchor::grid,
          1};
}

/// A bumpy piece in front of the camera, about 40 pixels across.
inline glm::vec3 bumpy(float u, float v) {
  const float z = 3.0f + 1.2f * u + 0.4f * std::sin(5.0f * u + 3.0f * v);
  return {z * (0.8f * u - 0.3f + 0.05f * std::sin(4.0f * v)), z * (0.7f * v - 0.4f + 0.1f * u * u),
          z};
}

}  // namespace tessera::test
