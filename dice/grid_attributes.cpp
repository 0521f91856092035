// The part of GridBuilder that fills in texture coordinates and primitive variables.

#include <algorithm>

#include "dice/grid_builder.h"
#include "dice/normals.h"

namespace tessera {

size_t Grid::memory_bytes() const {
  size_t floats = P_camera.capacity() + N_camera.capacity() + uv.capacity() + st.capacity() +
                  key_times.capacity();
  for (const GridPrimvar& p : primvars) floats += p.values.capacity();
  return sizeof(Grid) + floats * sizeof(float) + primvars.capacity() * sizeof(GridPrimvar);
}

void GridBuilder::fill_attributes(uint32_t patch, std::span<const float> u,
                                  std::span<const float> v, Grid& grid) {
  const size_t stride = grid.stride();
  grid.uv.resize(2 * stride);
  grid.st.resize(2 * stride);
  fill_uv(patch, u, v, grid.uv.data(), stride);
  fill_st(patch, u, v, grid.uv.data(), grid.st.data(), stride);
  for (const PatchPrimvar& primvar : context_.patches->primvars(patch, context_.wants_primvar)) {
    GridPrimvar out;
    out.source = primvar.source;
    out.components = primvar.components;
    out.values.resize(size_t(out.components) * stride);
    primvar.evaluate(u, v, out.values.data(), stride);
    grid.primvars.push_back(std::move(out));
  }
}

void GridBuilder::fill_uv(uint32_t patch, std::span<const float> u, std::span<const float> v,
                          float* uv, size_t stride) {
  const ParameterRect r = context_.patches->surface_parameters(patch);
  const float u0 = float(r.u0), u1 = float(r.u1), v0 = float(r.v0), v1 = float(r.v1);
  // In this form the ends are exact: neighbouring patches agree on the parameter between them.
  for (size_t k = 0; k < u.size(); ++k) uv[k] = (1.0f - u[k]) * u0 + u[k] * u1;
  for (size_t k = 0; k < v.size(); ++k) uv[stride + k] = (1.0f - v[k]) * v0 + v[k] * v1;
}

void GridBuilder::fill_st(uint32_t patch, std::span<const float> u, std::span<const float> v,
                          const float* uv, float* st, size_t stride) {
  bool has_s = false, has_t = false;
  const auto is_st = [](std::string_view name) {
    return name == "st" || name == "s" || name == "t";
  };
  for (const PatchPrimvar& p : context_.patches->primvars(patch, is_st)) {
    const std::string& name = p.source->name;
    if (name == "st" && p.components == 2) {
      p.evaluate(u, v, st, stride);
      return;
    }
    if (p.components != 1) continue;
    p.evaluate(u, v, name == "s" ? st : st + stride, stride);
    (name == "s" ? has_s : has_t) = true;
  }
  if (has_s && has_t) return;
  if (const auto given = context_.patches->default_st(patch)) {
    given->evaluate(u, v, st, stride);
    return;
  }
  PatchPrimvar corners;
  corners.components = 2;
  for (const glm::vec2& c : context_.surface->attributes->texture_coordinates) {
    corners.values.push_back(c.x);
    corners.values.push_back(c.y);
  }
  corners.evaluate({uv, u.size()}, {uv + stride, u.size()}, st, stride);
}

void GridBuilder::apply_vertex_normals(uint32_t patch, Grid& grid) {
  const auto is_normal = [](std::string_view name) { return name == "N"; };
  const std::vector<PatchPrimvar> found = context_.patches->primvars(patch, is_normal);
  if (found.empty() || found[0].components != 3) return;
  const size_t count = size_t(grid.vertex_count()), stride = grid.stride();
  AlignedVector<float> object(3 * stride);
  found[0].evaluate({vertex_u_.data(), count}, {vertex_v_.data(), count}, object.data(), stride);
  // Normals go by the inverse transpose, which is the matrix of cofactors over the determinant:
  // unlike a cross product they keep the side they point to.
  const glm::dmat3 map =
      glm::transpose(glm::inverse(glm::dmat3(context_.points->camera_from_object(0))));
  for (size_t k = 0; k < count; ++k) {
    const glm::dvec3 n = map * glm::dvec3(object[k], object[stride + k], object[2 * stride + k]);
    const double length = glm::length(n);
    if (!(length > 0) || !std::isfinite(length)) continue;
    for (size_t axis = 0; axis < 3; ++axis) {
      grid.N_camera[axis * stride + k] = float(n[int(axis)] / length);
    }
  }
}

}  // namespace tessera
