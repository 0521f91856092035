#pragma once
/// What samples see, by long double rays: a Moeller-Trumbore test in camera space that knows
/// nothing of raster clip space, and beside it how far the rounding of a hider may move the answer.
///
/// **Doubt.** A hider's dx and dy of a corner are off by at most `relative_rounding` of the sum of
/// the sizes that went into them (docs/visibility.md counts the roundings); e_ij = dx_i dy_j - dx_j
/// dy_i by what follows from that. A triangle is certain at a sample if the signs of its edge
/// functions decide whatever those errors are, and if its depth is clear of the clipping planes.

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/hide/hide_fixture.h"

namespace tessera {

using Real = long double;

inline constexpr Real relative_rounding = 64 * 0x1p-24L;

/// Barycentric coordinates of the ray's meeting with the triangle's plane, and its distance, which
/// is its camera z. Not finite if the ray is parallel to the plane.
struct Meeting {
  Real b0, b1, b2, distance;
  Real margin() const { return std::min({b0, b1, b2}); }
};

inline Meeting meet(const Camera::Ray& ray, const std::array<glm::dvec3, 3>& p) {
  using V = glm::vec<3, Real>;
  const V o(ray.origin), d(ray.direction), a(p[0]), e1 = V(p[1]) - a, e2 = V(p[2]) - a;
  const V n = glm::cross(d, e2), s = o - a, q = glm::cross(s, e1);
  const Real det = glm::dot(e1, n);
  const Real b1 = glm::dot(s, n) / det, b2 = glm::dot(d, q) / det;
  return {1 - b1 - b2, b1, b2, glm::dot(e2, q) / det};
}

struct SampleRay {
  Camera::Ray ray;
  double t;
};

inline SampleRay sample_ray(const TestBucket& bucket, size_t s) {
  const SampleBlock& b = bucket.samples;
  const glm::dvec2 lens = b.u.empty() ? glm::dvec2(0.0) : glm::dvec2(b.u[s], b.v[s]);
  return {bucket.camera.ray_camera({b.x[s], b.y[s]}, lens), b.t.empty() ? 0.0 : double(b.t[s])};
}

/// A corner seen from a sample in raster clip space, with what a hider may be off by.
struct SeenCorner {
  Real dx, dy, z;
  Real dx_error, dy_error, z_error;
};

/// `P` at the sample's time; `keys` its positions at the ends of the segment, whose rounding is
/// relative to the larger.
inline SeenCorner see_corner(const TestBucket& bucket, size_t s, const glm::dvec3& P,
                             const std::array<glm::dvec3, 2>& keys) {
  const SampleBlock& b = bucket.samples;
  const RasterClipMap& m = bucket.camera.raster_clip();
  const Real x = b.x[s], y = b.y[s], u = b.u.empty() ? 0 : Real(b.u[s]),
             v = b.v.empty() ? 0 : Real(b.v[s]);
  const auto W = [&](Real z) { return Real(m.w_from_z) * z + Real(m.w_constant); };
  const auto coc = [](const AffineInZ& a, Real z) { return Real(a.scale) * z + Real(a.offset); };
  const Real w = W(P.z);
  SeenCorner c{};
  c.dx = Real(m.x_scale) * Real(P.x) + Real(m.x_from_w) * w + u * coc(m.coc_x, P.z) - x * w;
  c.dy = Real(m.y_scale) * Real(P.y) + Real(m.y_from_w) * w + v * coc(m.coc_y, P.z) - y * w;
  c.z = P.z;
  // Sizes need no more than double.
  const auto size_of = [](const AffineInZ& a, double z) {
    return std::abs(double(a.scale) * z) + std::abs(double(a.offset));
  };
  double dx_size = 0, dy_size = 0, z_size = 0;
  for (const glm::dvec3& k : keys) {
    const double wk = std::abs(double(m.w_from_z) * k.z + double(m.w_constant));
    dx_size = std::max(dx_size, std::abs(double(m.x_scale) * k.x) +
                                    (std::abs(double(m.x_from_w)) + std::abs(double(x))) * wk +
                                    std::abs(double(u)) * size_of(m.coc_x, k.z));
    dy_size = std::max(dy_size, std::abs(double(m.y_scale) * k.y) +
                                    (std::abs(double(m.y_from_w)) + std::abs(double(y))) * wk +
                                    std::abs(double(v)) * size_of(m.coc_y, k.z));
    z_size = std::max(z_size, std::abs(k.z));
  }
  c.dx_error = relative_rounding * Real(dx_size), c.dy_error = relative_rounding * Real(dy_size);
  c.z_error = relative_rounding * Real(z_size);
  return c;
}

/// A triangle at a sample: the ray's answer, and whether rounding may change it.
struct Sighting {
  bool inside = false, doubtful = false;
  Real z = 0;        ///< camera depth if inside
  Real z_error = 0;  ///< what a hider's depth may be off by
};

/// True if the sample is to one side of all corners along x or along y whatever is rounded: no
/// weights >= 0 then make sum(l_k dx_k) = sum(l_k dy_k) = 0, which is to be on the triangle.
inline bool surely_beside(const std::array<SeenCorner, 3>& c) {
  const auto all = [&](auto&& test) { return test(c[0]) && test(c[1]) && test(c[2]); };
  return all([](const SeenCorner& k) { return k.dx > k.dx_error; }) ||
         all([](const SeenCorner& k) { return k.dx < -k.dx_error; }) ||
         all([](const SeenCorner& k) { return k.dy > k.dy_error; }) ||
         all([](const SeenCorner& k) { return k.dy < -k.dy_error; });
}

/// From the corners' errors: can the edge functions' signs be other than the ray's answer, and by
/// how much can the depth be off?
inline void judge_rounding(const std::array<SeenCorner, 3>& c, Sighting& s) {
  Real e[3], error[3], sum = 0, sum_error = 0, z_error = 0;
  for (int k = 0; k < 3; ++k) {
    const SeenCorner &i = c[size_t(k + 1) % 3], &j = c[size_t(k + 2) % 3];
    e[k] = i.dx * j.dy - j.dx * i.dy;
    const auto product = [](Real a, Real a_error, Real b, Real b_error) {
      return std::abs(a) * b_error + std::abs(b) * a_error + a_error * b_error;
    };
    error[k] =
        product(i.dx, i.dx_error, j.dy, j.dy_error) + product(j.dx, j.dx_error, i.dy, i.dy_error);
    sum += e[k], sum_error += error[k];
  }
  bool above = false, below = false, sure = true;
  for (int k = 0; k < 3; ++k) {
    above |= e[k] > error[k], below |= e[k] < -error[k];
    sure &= std::abs(e[k]) > error[k];
    z_error += error[k] * std::abs(c[size_t(k)].z - s.z);
  }
  s.doubtful = !surely_beside(c) && !(above && below) && !(sure && std::abs(sum) > sum_error);
  const Real rest = std::abs(sum) - sum_error;
  s.z_error = rest > 0 ? z_error / rest : INFINITY;
  s.z_error += std::max({c[0].z_error, c[1].z_error, c[2].z_error});
}

/// The ends of the segment that owns time t, or the only key twice.
inline std::array<glm::dvec3, 2> segment_ends(const Grid& grid, int vertex, double t) {
  const auto at = [&](int key) {
    return glm::dvec3(grid.P(key, 0)[vertex], grid.P(key, 1)[vertex], grid.P(key, 2)[vertex]);
  };
  if (grid.key_count() == 1) return {at(0), at(0)};
  int key = 0;
  while (key + 2 < grid.key_count() && t >= double(grid.key_times[size_t(key) + 1])) ++key;
  return {at(key), at(key + 1)};
}

/// The vertices of a grid at a sample. Reusable.
struct SeenGrid {
  std::vector<glm::dvec3> P;
  std::vector<SeenCorner> corners;

  void see(const TestBucket& bucket, size_t s, double t, const Grid& grid) {
    P.clear(), corners.clear();
    for (int i = 0; i < grid.vertex_count(); ++i) {
      P.push_back(vertex_at(grid, i, t));
      corners.push_back(see_corner(bucket, s, P.back(), segment_ends(grid, i, t)));
    }
  }
};

inline Sighting sight(const Camera& camera, const Camera::Ray& ray, const SeenGrid& seen,
                      const std::array<int, 3>& v) {
  std::array<glm::dvec3, 3> p;
  std::array<SeenCorner, 3> corners;
  for (size_t k = 0; k < 3; ++k)
    p[k] = seen.P[size_t(v[k])], corners[k] = seen.corners[size_t(v[k])];
  const Meeting m = meet(ray, p);
  const Real near = camera.near_clip(), far = camera.far_clip();
  Sighting result;
  const bool meets = m.margin() >= 0 && std::isfinite(m.distance);
  result.z = meets ? m.distance : 0;
  result.inside = meets && m.distance >= near && m.distance <= far;
  judge_rounding(corners, result);
  // Behind a clipping plane whatever is rounded: certain, wherever the edges are.
  const auto [low, high] = std::minmax({corners[0].z, corners[1].z, corners[2].z});
  const Real slack = std::max({corners[0].z_error, corners[1].z_error, corners[2].z_error});
  if (high + slack < near || low - slack > far)
    result.doubtful = false;
  else if (meets && (std::abs(result.z - near) <= result.z_error ||
                     std::abs(result.z - far) <= result.z_error))
    result.doubtful = true;
  return result;
}

/// The nearest triangle at a sample.
struct RayHit {
  Real z = INFINITY, z_error = 0;
  int grid = -1, triangle = -1;
  int layers = 0;         ///< triangles hit, whatever is in front
  bool doubtful = false;  ///< rounding may add or remove a hit
};

inline RayHit trace(const TestBucket& bucket, size_t s) {
  const SampleRay r = sample_ray(bucket, s);
  RayHit best;
  SeenGrid vertices;
  for (size_t g = 0; g < bucket.grids.size(); ++g) {
    const Grid& grid = *bucket.grids[g];
    vertices.see(bucket, s, r.t, grid);
    for (int k = 0; k < 2 * grid.micropolygon_count(); ++k) {
      const Sighting seen = sight(bucket.camera, r.ray, vertices, triangle_vertices(grid, k));
      best.doubtful |= seen.doubtful;
      if (!seen.inside) continue;
      ++best.layers;
      // Where two depths cannot be told apart, either may be reported.
      if (std::abs(seen.z - best.z) <= seen.z_error + best.z_error) {
        best.z_error = std::max(best.z_error, seen.z_error) + std::abs(seen.z - best.z);
        if (seen.z < best.z) best.z = seen.z;
      } else if (seen.z < best.z) {
        best.z = seen.z, best.z_error = seen.z_error, best.grid = int(g), best.triangle = k;
      }
    }
  }
  return best;
}

/// A hider's nearest fragment at a sample against the ray's answer.
struct Comparison {
  bool agrees = true;    ///< to within rounding; not to be asked where `expected` is doubtful
  Real depth_error = 0;  ///< relative, where both hit
};

inline Comparison compare(const RayHit& expected, const FragmentList& list, size_t s) {
  const size_t first = list.first_of_sample[s];
  const bool seen = list.first_of_sample[s + 1] > first, hit = expected.layers > 0;
  if (!seen || !hit) return {seen == hit, 0};
  const Real error = std::abs(Real(list.z[first]) - expected.z);
  return {error <= expected.z_error, error / std::abs(expected.z)};
}

}  // namespace tessera
