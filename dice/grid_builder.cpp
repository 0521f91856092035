#include "dice/grid_builder.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "dice/bounds_kernel.h"
#include "dice/normals.h"

namespace tessera {

namespace {

void resize_runs(AlignedVector<float>& runs, size_t count) {
  if (runs.size() < count) runs.resize(count);
}

PatchOutput output_runs(AlignedVector<float>& P, AlignedVector<float>* N, size_t stride) {
  PatchOutput out;
  for (size_t axis = 0; axis < 3; ++axis) {
    out.P[axis] = P.data() + axis * stride;
    if (N) out.N[axis] = N->data() + axis * stride;
  }
  return out;
}

// Index of grid vertex i along a side.
int vertex_on_side(const Grid& grid, int side, int i) {
  const int width = grid.u_count + 1;
  switch (side) {
    case 0:
      return i;
    case 1:
      return i * width + grid.u_count;
    case 2:
      return grid.v_count * width + i;
    default:
      return i * width;
  }
}

}  // namespace

std::unique_ptr<Grid> GridBuilder::build(const Piece& piece) {
  auto grid = std::make_unique<Grid>();
  lay_out(piece, *grid);
  evaluate_interior(piece, *grid);
  boundary_.clear();
  // Corners are written twice: last by sides 0 and 2, in every grid alike.
  for (int side : {3, 1, 0, 2}) evaluate_side(piece, side, *grid);
  const size_t stride = grid->stride();
  if (context_.displacer) {
    for (AlignedVector<float>& normals : key_normals_) {
      float* const N[3] = {normals.data(), normals.data() + stride, normals.data() + 2 * stride};
      make_unit_normals(*grid, N, grid->normal_sign);
    }
    std::copy_n(key_normals_[0].data(), 3 * stride, grid->N_camera.data());
  } else {
    float* const N[3] = {grid->N_camera.data(), grid->N_camera.data() + stride,
                         grid->N_camera.data() + 2 * stride};
    make_unit_normals(*grid, N, grid->normal_sign);
  }
  const size_t count = size_t(grid->vertex_count());
  fill_attributes(piece.patch, {vertex_u_.data(), count}, {vertex_v_.data(), count}, *grid);
  if (context_.displacer) {
    displace(piece.patch, *grid);
  } else {
    apply_vertex_normals(piece.patch, *grid);
  }
  if (!set_bounds(*grid)) return nullptr;
  return grid;
}

void GridBuilder::lay_out(const Piece& piece, Grid& grid) {
  const int most = context_.rate.max_grid_size;
  grid.id = {context_.index, piece.patch, piece.path};
  grid.surface = context_.surface;
  grid.u_count = std::clamp(piece.u_count, 1, most);
  grid.v_count = std::clamp(piece.v_count, 1, most);
  grid.key_times = context_.points->times();
  grid.normal_sign = context_.points->normal_sign();
  grid.one_sided = !context_.surface->attributes->two_sided;
  const size_t stride = grid.stride(), keys = size_t(grid.key_count());
  grid.P_camera.resize(keys * 3 * stride);
  grid.N_camera.resize(3 * stride);
  if (context_.displacer) {
    key_normals_.resize(keys);
    for (AlignedVector<float>& normals : key_normals_) normals.assign(3 * stride, 0.0f);
  }
  const size_t width = size_t(grid.u_count) + 1, height = size_t(grid.v_count) + 1;
  resize_runs(u_, padded(width));
  resize_runs(v_, padded(height));
  resize_runs(vertex_u_, stride);
  resize_runs(vertex_v_, stride);
  const ParameterRect& r = piece.rect;
  for (size_t i = 0; i < u_.size(); ++i) {
    u_[i] = float(r.u0 + (r.u1 - r.u0) * double(std::min(i, width - 1)) / grid.u_count);
  }
  for (size_t j = 0; j < v_.size(); ++j) {
    v_[j] = float(r.v0 + (r.v1 - r.v0) * double(std::min(j, height - 1)) / grid.v_count);
  }
  for (size_t j = 0; j < height; ++j) {
    for (size_t i = 0; i < width; ++i) {
      vertex_u_[j * width + i] = u_[i];
      vertex_v_[j * width + i] = v_[j];
    }
  }
}

void GridBuilder::evaluate_interior(const Piece& piece, Grid& grid) {
  const size_t width = size_t(grid.u_count) + 1, height = size_t(grid.v_count) + 1;
  const size_t row = padded(width), plane = row * height, stride = grid.stride();
  resize_runs(scratch_, 6 * plane);
  PatchOutput out;
  for (size_t axis = 0; axis < 3; ++axis) out.P[axis] = scratch_.data() + axis * plane;
  const Patch& patch = *cache_.get(piece.patch);
  const auto copy_rows = [&](const float* from, float* to) {
    for (size_t j = 0; j < height; ++j) {
      std::memcpy(to + j * width, from + j * row, width * sizeof(float));
    }
  };
  for (int key = 0; key < grid.key_count(); ++key) {
    float* N = context_.displacer ? key_normals_[size_t(key)].data()
               : key == 0         ? grid.N_camera.data()
                                  : nullptr;
    for (size_t axis = 0; axis < 3; ++axis) {
      out.N[axis] = N ? scratch_.data() + (3 + axis) * plane : nullptr;
    }
    patch.tensor(key, {u_.data(), width}, {v_.data(), height}, row, out);
    for (int axis = 0; axis < 3; ++axis) {
      copy_rows(out.P[axis], grid.P(key, axis));
      if (N) copy_rows(out.N[axis], N + size_t(axis) * stride);
    }
  }
}

void GridBuilder::gather_edge_parameters(const Piece& piece, int side) {
  const EdgeSpan& edge = piece.edges[size_t(side)];
  const size_t count = size_t(edge.touched()) + 1, capacity = padded(count);
  for (AlignedVector<float>* run : {&edge_u_, &edge_v_, &edge_t_}) resize_runs(*run, capacity);
  const ParameterRect& r = piece.rect;
  for (size_t d = 0; d < capacity; ++d) {
    const int k = edge.begin + int(std::min(d, count - 1));
    const double own = edge.own_of(k);
    const glm::dvec2 uv = side == 0   ? glm::dvec2(own, r.v0)
                          : side == 1 ? glm::dvec2(r.u1, own)
                          : side == 2 ? glm::dvec2(own, r.v1)
                                      : glm::dvec2(r.u0, own);
    edge_u_[d] = float(uv.x);
    edge_v_[d] = float(uv.y);
    edge_t_[d] = float(edge.t_of(k));
  }
  constexpr int corners[4][2] = {{0, 1}, {1, 3}, {2, 3}, {0, 2}};
  const auto set_corner = [&](int vertex, int corner) {
    const glm::dvec2 uv = piece.corners[size_t(corner)];
    edge_u_[size_t(vertex - edge.begin)] = float(uv.x);
    edge_v_[size_t(vertex - edge.begin)] = float(uv.y);
  };
  set_corner(edge.low(), corners[side][0]);
  set_corner(edge.high(), corners[side][1]);
}

void GridBuilder::evaluate_location(const Location& location, int key, float* const P[3],
                                    size_t at) {
  alignas(64) float t[16] = {}, u[16] = {}, v[16] = {}, xyz[3][16];
  const Patch& patch = *cache_.get(location.curve.patch);
  const PatchOutput out{{xyz[0], xyz[1], xyz[2]}, {}};
  const glm::dvec2 uv = location.curve.parameters(location.t);
  t[0] = float(location.t), u[0] = float(uv.x), v[0] = float(uv.y);
  if (location.curve.is_side()) {
    patch.side(key, int(location.curve.line), location.curve.flip, {t, 1}, out);
  } else {
    patch.points(key, {u, 1}, {v, 1}, out);
  }
  for (int axis = 0; axis < 3; ++axis) P[axis][at] = xyz[axis][0];
}

void GridBuilder::evaluate_side(const Piece& piece, int side, Grid& grid) {
  const EdgeSpan& edge = piece.edges[size_t(side)];
  const size_t count = size_t(edge.touched()) + 1, capacity = padded(count);
  const int along = side % 2 ? grid.v_count : grid.u_count;
  gather_edge_parameters(piece, side);
  for (AlignedVector<float>* run : {&edge_P_, &edge_N_, &edge_own_P_}) {
    resize_runs(*run, 3 * capacity);
  }
  const Patch& own = *cache_.get(piece.patch);
  const Patch& owner = *cache_.get(edge.curve.patch);
  const PatchOutput shared = output_runs(edge_P_, nullptr, capacity);
  const PatchOutput with_normals = output_runs(edge_own_P_, &edge_N_, capacity);
  const size_t stride = grid.stride();
  for (int key = 0; key < grid.key_count(); ++key) {
    // Positions everybody agrees on, ...
    if (edge.curve.is_side()) {
      owner.side(key, int(edge.curve.line), edge.curve.flip, {edge_t_.data(), count}, shared);
    } else {
      // ... of an own line; gather_edge_parameters gave the curve's parameters except at its ends.
      own.points(key, {edge_u_.data(), count}, {edge_v_.data(), count}, shared);
    }
    for (int k : {edge.begin, edge.end}) {
      evaluate_location(edge.location_of(k), key, shared.P, size_t(k - edge.begin));
    }
    // ... normals of one's own.
    float* N = context_.displacer ? key_normals_[size_t(key)].data()
               : key == 0         ? grid.N_camera.data()
                                  : nullptr;
    if (N) own.points(key, {edge_u_.data(), count}, {edge_v_.data(), count}, with_normals);
    for (int i = 0; i <= along; ++i) {
      const int vertex = vertex_on_side(grid, side, i),
                from = edge.vertex_at(i, along) - edge.begin;
      for (int axis = 0; axis < 3; ++axis) {
        grid.P(key, axis)[vertex] = shared.P[axis][from];
        if (N) N[size_t(axis) * stride + size_t(vertex)] = with_normals.N[axis][from];
      }
    }
  }
  for (int i = 0; i <= along; ++i) {
    const int vertex = vertex_on_side(grid, side, i), k = edge.vertex_at(i, along);
    vertex_u_[size_t(vertex)] = edge_u_[size_t(k - edge.begin)];
    vertex_v_[size_t(vertex)] = edge_v_[size_t(k - edge.begin)];
    if (context_.displacer) boundary_.push_back({vertex, edge.location_of(k)});
  }
}

bool GridBuilder::set_bounds(Grid& grid) const {
  VertexBounds bounds;
  const RasterProjection& projection = *context_.rate.projection;
  for (int key = 0; key < grid.key_count(); ++key) {
    add_vertex_bounds(projection.map(), projection.lens_extent(), grid.P(key, 0), grid.P(key, 1),
                      grid.P(key, 2), size_t(grid.vertex_count()), bounds);
  }
  grid.z_min = bounds.z_min;
  grid.z_max = bounds.z_max;
  const RasterBounds& box = bounds.raster;
  const bool bounded = bounds.in_front && std::isfinite(box.x_max - box.x_min) &&
                       std::isfinite(box.y_max - box.y_min);
  grid.raster_bounds = bounded ? box : RasterBounds::everything();
  return bounds.finite;
}

}  // namespace tessera
