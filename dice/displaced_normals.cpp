// The part of GridBuilder that finds the normals of a displaced grid along its boundary.
//
// There differences of the grid's own vertices would be one-sided, and the grid beyond the edge
// would find another normal. So a boundary vertex is given a stencil instead: a few points of the
// patch around the place that all grids at the vertex agree on, displaced as vertices are. How
// wide it is depends on that place alone, so those grids find the same normal.

#include <algorithm>
#include <cmath>
#include <map>

#include "dice/grid_builder.h"
#include "dice/normals.h"
#include "dice/passage.h"

namespace tessera {

namespace {

constexpr size_t stencil_points = 5;  // the place itself, two more along u, two more along v

// Where to take a derivative at x from, besides x: both sides of it, unless the patch ends there.
std::array<float, 2> derivative_nodes(float x, float step) {
  if (x - step < 0) return {x + step, x + 2 * step};
  if (x + step > 1) return {x - step, x - 2 * step};
  return {x - step, x + step};
}

// Derivative at x of the parabola through three points; exact parameters make up for their
// rounding where steps are small.
glm::dvec3 derivative(const glm::dvec3 f[3], double x, double x1, double x2) {
  const double d1 = x1 - x, d2 = x2 - x;
  return ((f[1] - f[0]) * (d2 / d1) - (f[2] - f[0]) * (d1 / d2)) / (d2 - d1);
}

glm::vec3 point(const AlignedVector<float>& P, size_t stride, size_t at) {
  return {P[at], P[stride + at], P[2 * stride + at]};
}

glm::dvec3 unit_or_zero(const glm::dvec3& n) {
  const double length = glm::length(n);
  return length > 0 && std::isfinite(length) ? n / length : glm::dvec3(0);
}

// Pixels from one of two points to the other on the way between two keys. Seen edge on they stop
// shrinking, at half of what they are when seen squarely.
float probe_pixels(const RasterProjection& projection, const MovingSegment& s) {
  const auto across = [](const glm::vec3& a, const glm::vec3& b) {
    return a + glm::vec3(glm::distance(a, b), 0, 0);
  };
  const MovingSegment squarely{s.a0, across(s.a0, s.b0), s.a1, across(s.a1, s.b1)};
  return std::max(longest_length(projection, s), 0.5f * longest_length(projection, squarely));
}

// Parameter step that is about as long as a micropolygon, if `probe` is `pixels` long.
float stencil_step(const DiceRate& rate, float pixels, float probe) {
  constexpr float narrowest = float(DiceRate::min_width) / 32;
  return pixels > 0 ? std::clamp(probe * rate.step / pixels, narrowest, 0.25f) : 0.25f;
}

// A place of a patch, and the ends of the probes from there along u and v.
struct Probes {
  glm::vec3 p, pu, pv;
};

// The probes at `key`, from 3 parameters a place.
std::vector<Probes> probes_at(const Patch& patch, int key, const AlignedVector<float>& u,
                              const AlignedVector<float>& v, size_t places) {
  const size_t stride = u.size();
  AlignedVector<float> P(3 * stride);
  patch.points(key, {u.data(), 3 * places}, {v.data(), 3 * places},
               PatchOutput{{P.data(), P.data() + stride, P.data() + 2 * stride}, {}});
  std::vector<Probes> probes;
  for (size_t k = 0; k < 3 * places; k += 3) {
    probes.push_back({point(P, stride, k), point(P, stride, k + 1), point(P, stride, k + 2)});
  }
  return probes;
}

// The most pixels that the probes span along u and v at any time.
std::vector<glm::vec2> pixels_of(const Patch& patch, const DiceRate& rate,
                                 const AlignedVector<float>& u, const AlignedVector<float>& v,
                                 std::vector<Probes> from) {
  std::vector<glm::vec2> pixels(from.size(), glm::vec2(0));
  for (int key = 0; key < rate.key_count(); ++key) {
    std::vector<Probes> to = probes_at(patch, key, u, v, from.size());
    for (size_t i = 0; i < to.size(); ++i) {
      const Probes &a = from[i], &b = to[i];
      pixels[i].x = std::max(pixels[i].x, probe_pixels(*rate.projection, {a.p, a.pu, b.p, b.pu}));
      pixels[i].y = std::max(pixels[i].y, probe_pixels(*rate.projection, {a.p, a.pv, b.p, b.pv}));
    }
    from = std::move(to);
  }
  return pixels;
}

}  // namespace

std::vector<glm::dvec3> GridBuilder::place_stencils(const Patch& patch,
                                                    std::span<const glm::dvec2> places,
                                                    AlignedVector<float>& u,
                                                    AlignedVector<float>& v) const {
  // Short enough for the tangents of the surface, long enough for single precision.
  constexpr float probe = 1.0f / 256;
  const size_t count = places.size(), stride = padded(3 * count);
  u.assign(stride, 0.0f), v.assign(stride, 0.0f);
  for (size_t i = 0; i < count; ++i) {
    const float x = float(places[i].x), y = float(places[i].y);
    u[3 * i] = u[3 * i + 2] = x, u[3 * i + 1] = x < 0.5f ? x + probe : x - probe;
    v[3 * i] = v[3 * i + 1] = y, v[3 * i + 2] = y < 0.5f ? y + probe : y - probe;
  }
  const std::vector<Probes> probes = probes_at(patch, 0, u, v, count);
  const std::vector<glm::vec2> pixels = pixels_of(patch, context_.rate, u, v, probes);

  const size_t run = padded(stencil_points * count);
  u.assign(run, 0.0f), v.assign(run, 0.0f);
  std::vector<glm::dvec3> normals;
  for (size_t i = 0; i < count; ++i) {
    const float x = float(places[i].x), y = float(places[i].y);
    const auto& [p, pu, pv] = probes[i];
    const double sign = (x < 0.5f) == (y < 0.5f) ? 1 : -1;
    normals.push_back(unit_or_zero(sign * glm::cross(glm::dvec3(pu - p), glm::dvec3(pv - p))));
    const auto along_u = derivative_nodes(x, stencil_step(context_.rate, pixels[i].x, probe));
    const auto along_v = derivative_nodes(y, stencil_step(context_.rate, pixels[i].y, probe));
    const size_t at = stencil_points * i;
    std::fill_n(u.data() + at, stencil_points, x);
    std::fill_n(v.data() + at, stencil_points, y);
    u[at + 1] = along_u[0], u[at + 2] = along_u[1];
    v[at + 3] = along_v[0], v[at + 4] = along_v[1];
  }
  return normals;
}

std::vector<GridBuilder::StencilNormals> GridBuilder::stencil_normals(
    uint32_t patch, std::span<const glm::dvec2> places, float normal_sign) {
  AlignedVector<float> u, v;
  const std::vector<glm::dvec3> surface = place_stencils(*cache_.get(patch), places, u, v);
  // One stencil a row, so that a displacer sees a grid like any other.
  Grid grid;
  grid.id = {context_.index, patch, 0};
  grid.surface = context_.surface;
  grid.normal_sign = normal_sign;
  grid.u_count = int(stencil_points) - 1;
  grid.v_count = int(places.size()) - 1;
  const size_t stride = grid.stride(), count = stencil_points * places.size();
  grid.P_camera.resize(3 * stride);
  grid.N_camera.resize(3 * stride);
  float* const N[3] = {grid.N_camera.data(), grid.N_camera.data() + stride,
                       grid.N_camera.data() + 2 * stride};
  const PatchOutput out{{grid.P(0, 0), grid.P(0, 1), grid.P(0, 2)}, {N[0], N[1], N[2]}};
  cache_.get(patch)->points(0, {u.data(), count}, {v.data(), count}, out);
  make_unit_normals(grid, N, normal_sign);
  fill_attributes(patch, {u.data(), count}, {v.data(), count}, grid);

  const AlignedVector<float> distance = distances(grid);
  for (size_t axis = 0; axis < 3; ++axis) {
    for (size_t k = 0; k < count; ++k) {
      grid.P_camera[axis * stride + k] += distance[k] * grid.N_camera[axis * stride + k];
    }
  }
  std::vector<StencilNormals> normals(places.size());
  for (size_t i = 0; i < places.size(); ++i) {
    const size_t at = stencil_points * i;
    const auto p = [&](size_t k) { return glm::dvec3(point(grid.P_camera, stride, at + k)); };
    const glm::dvec3 along_u[3] = {p(0), p(1), p(2)}, along_v[3] = {p(0), p(3), p(4)};
    const glm::dvec3 n = glm::cross(derivative(along_u, u[at], u[at + 1], u[at + 2]),
                                    derivative(along_v, v[at], v[at + 3], v[at + 4]));
    normals[i] = {surface[i], unit_or_zero(n * double(normal_sign))};
  }
  return normals;
}

void GridBuilder::displaced_boundary_normals(uint32_t own_patch, Grid& grid) {
  struct Places {
    std::vector<int> vertices;
    std::vector<glm::dvec2> uv;
    void add(int vertex, const glm::dvec2& at) { vertices.push_back(vertex), uv.push_back(at); }
  };
  std::map<uint32_t, Places> by_patch;
  Places shared;  // the grid's own view of what belongs to other patches
  for (const BoundaryVertex& b : boundary_) {
    const Curve& curve = b.location.curve;
    by_patch[curve.patch].add(b.vertex, curve.parameters(b.location.t));
    if (curve.patch == own_patch) continue;
    shared.add(b.vertex, {vertex_u_[size_t(b.vertex)], vertex_v_[size_t(b.vertex)]});
  }
  std::map<int, StencilNormals> own;
  if (!shared.uv.empty()) {
    const auto normals = stencil_normals(own_patch, shared.uv, grid.normal_sign);
    for (size_t i = 0; i < normals.size(); ++i) own[shared.vertices[i]] = normals[i];
  }
  // Patches that meet at more than three degrees meet in a crease, and keep their own normals.
  constexpr double smooth = 0.9986;
  for (const auto& [patch, places] : by_patch) {
    const auto normals = stencil_normals(patch, places.uv, grid.normal_sign);
    for (size_t i = 0; i < normals.size(); ++i) {
      const int vertex = places.vertices[i];
      StencilNormals found = normals[i];
      if (patch != own_patch && !(glm::dot(own[vertex].surface, found.surface) > smooth)) {
        found = own[vertex];
      }
      // Nothing at a pole or a collapsed side: the difference of vertices has to do.
      if (found.displaced == glm::dvec3(0)) continue;
      for (int axis = 0; axis < 3; ++axis) {
        grid.N_camera[size_t(axis) * grid.stride() + size_t(vertex)] = float(found.displaced[axis]);
      }
    }
  }
}

}  // namespace tessera
