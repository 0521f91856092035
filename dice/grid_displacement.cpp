// The part of GridBuilder that displaces a grid along its normals.

#include <algorithm>
#include <cmath>
#include <map>

#include "dice/grid_builder.h"
#include "dice/normals.h"

namespace tessera {

void GridBuilder::displace(uint32_t patch, Grid& grid) {
  const size_t stride = grid.stride();
  // Along the boundary, displacement must see what its neighbours see: the normals, texture
  // coordinates and variables of the patch that the edge belongs to. Shading afterwards wants the
  // grid's own.
  const AlignedVector<float> own_uv = grid.uv, own_st = grid.st;
  std::vector<AlignedVector<float>> own_primvars;
  for (const GridPrimvar& p : grid.primvars) own_primvars.push_back(p.values);
  boundary_normals(grid, key_normals_);
  std::copy_n(key_normals_[0].data(), 3 * stride, grid.N_camera.data());
  share_boundary_attributes(grid);

  const AlignedVector<float> distance = distances(grid);
  for (int key = 0; key < grid.key_count(); ++key) {
    for (int axis = 0; axis < 3; ++axis) {
      const float* N = key_normals_[size_t(key)].data() + size_t(axis) * stride;
      float* P = grid.P(key, axis);
      for (int k = 0; k < grid.vertex_count(); ++k) P[k] += distance[size_t(k)] * N[k];
    }
  }
  grid.uv = own_uv;
  grid.st = own_st;
  for (size_t p = 0; p < own_primvars.size(); ++p) grid.primvars[p].values = own_primvars[p];
  float* const N[3] = {grid.N_camera.data(), grid.N_camera.data() + stride,
                       grid.N_camera.data() + 2 * stride};
  normals_from_positions(grid, 0, N);
  make_unit_normals(grid, N, grid.normal_sign);
  displaced_boundary_normals(patch, grid);
}

AlignedVector<float> GridBuilder::distances(const Grid& grid) {
  AlignedVector<float> distance(grid.stride(), 0.0f);
  context_.displacer->displace(grid, distance);
  const float bound = context_.displacement_bound;
  float largest = 0;
  for (int k = 0; k < grid.vertex_count(); ++k) {
    largest = std::max(largest, std::abs(distance[size_t(k)]));
    distance[size_t(k)] = std::clamp(distance[size_t(k)], -bound, bound);
  }
  if (largest > bound * 1.0001f) {
    const Geometry& geometry = *grid.surface->geometry;
    diagnostics_.warn_once(
        fmt::format("displacementbound {}:{}", geometry.where.file, geometry.where.line),
        geometry.where,
        fmt::format("displacement of {:g} (camera units) exceeds the displacement bound of {:g}; "
                    "it is cut there. Raise Attribute \"displacementbound\"",
                    largest, bound));
  }
  return distance;
}

void GridBuilder::boundary_normals(Grid& grid, std::vector<AlignedVector<float>>& normals) {
  alignas(64) float t[16] = {}, u[16] = {}, v[16] = {}, P[3][16], n[3][16];
  const PatchOutput out{{P[0], P[1], P[2]}, {n[0], n[1], n[2]}};
  const size_t stride = grid.stride();
  const auto unit = [&] { return glm::dvec3(n[0][0], n[1][0], n[2][0]); };
  for (const BoundaryVertex& b : boundary_) {
    const Patch& patch = *cache_.get(b.location.curve.patch);
    for (int key = 0; key < grid.key_count(); ++key) {
      glm::dvec2 uv = b.location.curve.parameters(b.location.t);
      t[0] = float(b.location.t), u[0] = float(uv.x), v[0] = float(uv.y);
      if (b.location.curve.is_side()) {
        patch.side(key, int(b.location.curve.line), b.location.curve.flip, {t, 1}, out);
      } else {
        patch.points(key, {u, 1}, {v, 1}, out);
      }
      double length = glm::length(unit());
      if (!(length > 1e-30)) {
        // A pole or a collapsed side: look from a little inside the owner's patch.
        uv += 1e-3 * (glm::dvec2(0.5) - uv);
        u[0] = float(uv.x), v[0] = float(uv.y);
        patch.points(key, {u, 1}, {v, 1}, out);
        length = glm::length(unit());
      }
      const glm::dvec3 N =
          length > 0 ? unit() * (double(grid.normal_sign) / length) : glm::dvec3(0);
      for (size_t axis = 0; axis < 3; ++axis) {
        normals[size_t(key)][axis * stride + size_t(b.vertex)] = float(N[int(axis)]);
      }
    }
  }
}

void GridBuilder::share_boundary_attributes(Grid& grid) {
  std::map<uint32_t, std::vector<const BoundaryVertex*>> by_patch;
  for (const BoundaryVertex& b : boundary_) by_patch[b.location.curve.patch].push_back(&b);
  const size_t stride = grid.stride();
  for (const auto& [patch, vertices] : by_patch) {
    const size_t count = vertices.size(), run = padded(count);
    AlignedVector<float> u(run), v(run), uv(2 * run), values(2 * run);
    for (size_t i = 0; i < count; ++i) {
      const Location& location = vertices[i]->location;
      const glm::dvec2 at = location.curve.parameters(location.t);
      u[i] = float(at.x), v[i] = float(at.y);
    }
    const std::span<const float> us{u.data(), count}, vs{v.data(), count};
    const auto scatter = [&](const float* from, int components, float* to) {
      for (size_t c = 0; c < size_t(components); ++c) {
        for (size_t i = 0; i < count; ++i) {
          to[c * stride + size_t(vertices[i]->vertex)] = from[c * run + i];
        }
      }
    };
    fill_uv(patch, us, vs, uv.data(), run);
    fill_st(patch, us, vs, uv.data(), values.data(), run);
    scatter(values.data(), 2, grid.st.data());
    scatter(uv.data(), 2, grid.uv.data());
    const std::vector<PatchPrimvar> found =
        context_.patches->primvars(patch, context_.wants_primvar);
    for (size_t p = 0; p < std::min(found.size(), grid.primvars.size()); ++p) {
      values.assign(size_t(found[p].components) * run, 0.0f);
      found[p].evaluate(us, vs, values.data(), run);
      scatter(values.data(), found[p].components, grid.primvars[p].values.data());
    }
  }
}

}  // namespace tessera
