#pragma once
/// A ray tracer that tries every triangle, and places to shine from, for the tests of light by
/// rays.

#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "base/hash.h"
#include "shade/light.h"
#include "shade/mathematics.h"
#include "shade/ray_tracer.h"
#include "tests/shade/fixtures.h"

namespace tessera::test {

/// In double precision. Opacity of a surface is the mean of its attributes'. Hits on the ray's own
/// surface within `own` of the origin do not count.
class BruteTracer : public RayTracer {
 public:
  explicit BruteTracer(std::vector<std::shared_ptr<const Grid>> grids, double own = 1e-4)
      : grids_(std::move(grids)), own_(own) {}

  void closest(const Rays& rays, RayHits& hits) const override {
    const size_t count = size_t(rays.count());
    hits.distance.assign(count, std::numeric_limits<float>::infinity());
    for (auto* values : {&hits.grid, &hits.triangle}) values->assign(count, 0);
    for (auto* values : {&hits.b1, &hits.b2}) values->assign(count, 0.0f);
    for (size_t i = 0; i < count; ++i) {
      for_hits(rays, i, [&](uint32_t grid, uint32_t triangle, double t, double b1, double b2) {
        if (!(float(t) < hits.distance[i])) return;
        hits.distance[i] = float(t), hits.grid[i] = grid, hits.triangle[i] = triangle;
        hits.b1[i] = float(b1), hits.b2[i] = float(b2);
      });
    }
  }
  void shadow(const Rays& rays, RayShadows& shadows) const override {
    const size_t count = size_t(rays.count());
    shadows.share.assign(count, 1.0f);
    shadows.distance.assign(count, std::numeric_limits<float>::infinity());
    for (size_t i = 0; i < count; ++i) {
      for_hits(rays, i, [&](uint32_t grid, uint32_t, double t, double, double) {
        const glm::vec3& opacity = grids_[grid]->attributes().opacity;
        shadows.share[i] *= 1.0f - (opacity.x + opacity.y + opacity.z) / 3.0f;
        shadows.distance[i] = std::min(shadows.distance[i], float(t));
      });
    }
  }
  std::span<const std::shared_ptr<const Grid>> grids() const override { return grids_; }
  size_t memory_bytes() const override { return 0; }

 private:
  static glm::dvec3 vertex(const Grid& grid, int k, double t) {
    glm::dvec3 result(0.0);
    for (int axis = 0; axis < 3; ++axis) {
      const double from = double(grid.P(0, axis)[k]);
      const double to = double(grid.P(grid.key_count() - 1, axis)[k]);
      result[axis] = from + t * (to - from);
    }
    return result;
  }
  template <class See>
  void for_hits(const Rays& rays, size_t i, const See& see) const {
    const glm::dvec3 o(rays.origin[int(i)]), d(rays.direction[int(i)]);
    if (!(glm::dot(d, d) > 0.0)) return;
    for (uint32_t g = 0; g < grids_.size(); ++g) {
      const Grid& grid = *grids_[g];
      const double least = grid.surface->id == rays.surface[i] ? own_ : 0.0;
      for (uint32_t k = 0; k < uint32_t(2 * grid.micropolygon_count()); ++k) {
        const auto corner = grid.triangle_corners(k);
        const double time = double(rays.time[i]);
        const glm::dvec3 a = vertex(grid, corner[0], time);
        const glm::dvec3 e1 = vertex(grid, corner[1], time) - a;
        const glm::dvec3 e2 = vertex(grid, corner[2], time) - a;
        const glm::dvec3 p = glm::cross(d, e2);
        const double det = glm::dot(e1, p);
        if (det == 0.0) continue;
        const glm::dvec3 s = o - a, q = glm::cross(s, e1);
        const double b1 = glm::dot(s, p) / det, b2 = glm::dot(d, q) / det;
        const double t = glm::dot(e2, q) / det;
        if (b1 < 0.0 || b2 < 0.0 || b1 + b2 > 1.0) continue;
        if (t > least && t < double(rays.far[i])) see(g, k, t, b1, b2);
      }
    }
  }
  std::vector<std::shared_ptr<const Grid>> grids_;
  double own_;
};

/// n x n places, one somewhere in each of as many equal squares.
inline std::vector<glm::vec2> spread_over_square(int n) {
  std::vector<glm::vec2> places;
  uint32_t state = 1;
  const auto jitter = [&] { return float(mix32(state++) >> 8) / 16777216.0f; };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const float x = (float(i) + jitter()) / float(n), y = (float(j) + jitter()) / float(n);
      places.emplace_back(std::min(x, 0.9999999f), std::min(y, 0.9999999f));
    }
  return places;
}

/// One vertex array of normals.
inline void set_normals(Grid& grid, const std::function<glm::vec3(float u, float v)>& N) {
  const size_t stride = grid.stride();
  for (size_t k = 0; k < size_t(grid.vertex_count()); ++k) {
    const glm::vec3 n = N(grid.uv[k], grid.uv[stride + k]);
    for (int axis = 0; axis < 3; ++axis) grid.N_camera[size_t(axis) * stride + k] = n[axis];
  }
  // Outward is where the normals point.
  const auto c = grid.triangle_corners(uint32_t(grid.micropolygon_count()));
  const auto at = [&](int k) {
    return glm::vec3(grid.P(0, 0)[k], grid.P(0, 1)[k], grid.P(0, 2)[k]);
  };
  const glm::vec3 cross = glm::cross(at(c[1]) - at(c[0]), at(c[2]) - at(c[0]));
  const glm::vec3 n(grid.N(0)[c[0]], grid.N(1)[c[0]], grid.N(2)[c[0]]);
  grid.normal_sign = glm::dot(cross, n) < 0.0f ? -1.0f : 1.0f;
}

/// A ball with outward normals.
inline std::shared_ptr<Grid> make_ball(const Surface& surface, glm::vec3 centre, float radius,
                                       int around = 32, int up = 24) {
  const auto outward = [](float u, float v) {
    const float a = 2.0f * pi * u, h = pi * v;
    return glm::vec3(std::cos(a) * std::sin(h), std::sin(a) * std::sin(h), std::cos(h));
  };
  auto grid = make_grid(surface, around, up,
                        [&](float u, float v) { return centre + radius * outward(u, v); });
  set_normals(*grid, outward);
  return grid;
}

/// Points of one surface at shutter open, for lights to be asked about.
struct LightPoints : BarePoints {
  std::vector<float> time;
  std::vector<int32_t> surface;

  LightPoints(const std::vector<glm::vec3>& at, const glm::vec3& normal, int of_surface = -1)
      : BarePoints(at, normal), time(at.size(), 0.0f), surface(at.size(), of_surface) {
    points.time = time.data(), points.surface = surface.data();
  }
};

/// A wall in the plane x = 0, `half_width` to both sides in y and from z = 0 to z = -height, and
/// the surface it belongs to. Its normal is +x.
inline std::shared_ptr<Grid> make_wall(const Surface& surface, int n, float half_width,
                                       float height) {
  auto grid = make_grid(surface, n, n, [=](float u, float v) {
    return glm::vec3(0.0f, (2.0f * u - 1.0f) * half_width, -height * v);
  });
  set_normals(*grid, [](float, float) { return glm::vec3(1.0f, 0.0f, 0.0f); });
  return grid;
}

}  // namespace tessera::test
