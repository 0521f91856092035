#include "shade/grid_points.h"

#include <algorithm>

#include "shade/view.h"

namespace tessera {

void grid_differences(const Grid& grid, const float* f, float* along_u, float* along_v) {
  const int row = grid.u_count + 1, rows = grid.v_count + 1;
  const auto cells = [](int low, int high) { return 1.0f / float(high - low); };
  for (int j = 0; j < rows; ++j) {
    const int below = std::max(j - 1, 0), above = std::min(j + 1, rows - 1);
    const float *centre = f + j * row, *f_below = f + below * row, *f_above = f + above * row;
    float* du = along_u + j * row;
    float* dv = along_v + j * row;
    const float per_row = cells(below, above);
    for (int i = 0; i < row; ++i) dv[i] = (f_above[i] - f_below[i]) * per_row;
    du[0] = centre[1] - centre[0];
    du[row - 1] = centre[row - 1] - centre[row - 2];
    for (int i = 1; i + 1 < row; ++i) du[i] = (centre[i + 1] - centre[i - 1]) * 0.5f;
  }
}

GridPoints::GridPoints(const Grid& grid, const Camera& camera, Footprints footprints) {
  const size_t stride = grid.stride();
  const Attributes& attributes = grid.attributes();
  points_.count = grid.vertex_count();
  points_.P = Vec3Input::varying(grid.P(0, 0), stride);
  points_.N = Vec3Input::varying(grid.N(0), stride);
  points_.Cs = Vec3Input::uniform(&attributes.color.x);
  points_.Os = Vec3Input::uniform(&attributes.opacity.x);
  points_.u = grid.uv.data();
  points_.v = grid.uv.data() + stride;
  points_.s = grid.st.data();
  points_.t = grid.st.data() + stride;
  points_.normal_sign = grid.normal_sign;
  points_.camera_from_object =
      camera.camera_from_world(0.0f) * grid.surface->world_from_object.at(0.0f);
  for (const GridPrimvar& primvar : grid.primvars) {
    points_.primvars.push_back({primvar.source, primvar.components, primvar.values.data(), stride});
    if (primvar.components != 3) continue;
    const Vec3Input values = Vec3Input::varying(primvar.values.data(), stride);
    if (primvar.source->name == "Cs") points_.Cs = values;
    if (primvar.source->name == "Os") points_.Os = values;
  }
  surface_.assign(size_t(points_.count), grid.surface->id);
  points_.surface = surface_.data();
  fill_incident(grid, camera);
  if (footprints == Footprints::over_micropolygons) fill_footprints(grid);
}

void GridPoints::fill_incident(const Grid& grid, const Camera& camera) {
  I_.reset(grid.vertex_count());
  for (int i = 0; i < I_.count(); ++i) I_.set(i, view_direction(camera, points_.P[i]));
  points_.I = I_;
}

void GridPoints::fill_footprints(const Grid& grid) {
  for (Vec3Array* array : {&dPdu_, &dPdv_, &dNdu_, &dNdv_}) array->reset(grid.vertex_count());
  for (int axis = 0; axis < 3; ++axis) {
    grid_differences(grid, grid.P(0, axis), dPdu_.component(axis), dPdv_.component(axis));
    grid_differences(grid, grid.N(axis), dNdu_.component(axis), dNdv_.component(axis));
  }
  points_.dPdx = dPdu_, points_.dPdy = dPdv_;
  points_.dNdx = dNdu_, points_.dNdy = dNdv_;
  const size_t stride = grid.stride();
  st_differences_.assign(4 * stride, 0.0f);
  float* d = st_differences_.data();
  grid_differences(grid, points_.s, d, d + 2 * stride);
  grid_differences(grid, points_.t, d + stride, d + 3 * stride);
  points_.st_footprint = {d, d + stride, d + 2 * stride, d + 3 * stride};
}

}  // namespace tessera
