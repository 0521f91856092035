#pragma once
// Scenes for the tests of rays, and what a search through every triangle says.

#include <cmath>
#include <random>
#include <set>

#include "rays/rays.h"
#include "tests/dice/dice_scene.h"

namespace tessera::test {

using TestPoint = glm::vec<3, long double>;

inline std::shared_ptr<const RayTracer> tracer_of(DiceScene& scene, RaySettings settings = {}) {
  return make_ray_tracer(scene.scene, Camera(scene.scene.camera), settings, scene.diagnostics);
}

inline Rays one_ray(const glm::vec3& origin, const glm::vec3& direction, float far = INFINITY,
                    float time = 0, int surface = -1) {
  Rays rays(1);
  for (int c = 0; c < 3; ++c) {
    rays.origin.component(c)[0] = origin[c];
    rays.direction.component(c)[0] = direction[c];
  }
  rays.far[0] = far, rays.time[0] = time, rays.surface[0] = surface;
  return rays;
}

inline void set_ray(Rays& rays, int i, const glm::vec3& origin, const glm::vec3& direction,
                    float far = INFINITY, float time = 0, int surface = -1) {
  for (int c = 0; c < 3; ++c) {
    rays.origin.component(c)[i] = origin[c];
    rays.direction.component(c)[i] = direction[c];
  }
  const size_t k = size_t(i);
  rays.far[k] = far, rays.time[k] = time, rays.surface[k] = surface;
}

inline RayHits closest(const RayTracer& tracer, const Rays& rays) {
  RayHits hits;
  tracer.closest(rays, hits);
  return hits;
}

inline RayShadows shadow(const RayTracer& tracer, const Rays& rays) {
  RayShadows shadows;
  tracer.shadow(rays, shadows);
  return shadows;
}

/// A point of a grid's vertex path at a time.
inline TestPoint vertex_at(const Grid& grid, int vertex, float time) {
  size_t key = 0;
  while (key + 2 < grid.key_times.size() && grid.key_times[key + 1] <= time) ++key;
  const auto at = [&](size_t k) {
    return TestPoint(grid.P(int(k), 0)[vertex], grid.P(int(k), 1)[vertex],
                     grid.P(int(k), 2)[vertex]);
  };
  if (grid.key_times.size() == 1) return at(0);
  const long double t0 = grid.key_times[key], t1 = grid.key_times[key + 1];
  return glm::mix(at(key), at(key + 1), (time - t0) / (t1 - t0));
}

/// One triangle that a ray meets.
struct Meeting {
  long double t, b1, b2;
  uint32_t grid, triangle;
  long double margin;  ///< least barycentric coordinate: near zero on an edge
};

/// Every triangle that a ray meets or nearly meets, by Cramer's rule.
inline std::vector<Meeting> meetings(const RayTracer& tracer, const glm::vec3& origin,
                                     const glm::vec3& direction, float time) {
  std::vector<Meeting> found;
  const TestPoint O(origin), D(direction);
  for (uint32_t g = 0; g < tracer.grids().size(); ++g) {
    const Grid& grid = *tracer.grids()[g];
    for (uint32_t k = 0; k < 2 * uint32_t(grid.micropolygon_count()); ++k) {
      const auto corners = grid.triangle_corners(k);
      const TestPoint A = vertex_at(grid, corners[0], time), B = vertex_at(grid, corners[1], time),
                      C = vertex_at(grid, corners[2], time);
      const TestPoint e1 = B - A, e2 = C - A, s = O - A;
      const long double det = glm::dot(glm::cross(D, e2), e1);
      if (det == 0) continue;
      const long double b1 = glm::dot(glm::cross(D, e2), s) / det,
                        b2 = glm::dot(glm::cross(s, e1), D) / det,
                        t = glm::dot(glm::cross(s, e1), e2) / det;
      const long double margin = std::min({b1, b2, 1 - b1 - b2});
      if (t > 0 && margin > -1e-4L) found.push_back({t, b1, b2, g, k, margin});
    }
  }
  std::sort(found.begin(), found.end(),
            [](const Meeting& a, const Meeting& b) { return a.t < b.t; });
  return found;
}

}  // namespace tessera::test
