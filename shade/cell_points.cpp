#include "shade/cell_points.h"

#include "shade/cell_normals.h"
#include "shade/vertex_reader.h"
#include "shade/view.h"

namespace tessera {

CellPoints::CellPoints(std::span<const CellPoint> cells, const Camera& camera) {
  const Grid& first = *cells.front().grid;
  const Attributes& attributes = first.attributes();
  points_.count = int(cells.size());
  points_.Cs = Vec3Input::uniform(&attributes.color.x);
  points_.Os = Vec3Input::uniform(&attributes.opacity.x);
  points_.camera_from_object =
      camera.camera_from_world(0.0f) * first.surface->world_from_object.at(0.0f);
  surface_.assign(cells.size(), first.surface->id);
  points_.surface = surface_.data();
  fill_geometry(cells, camera);
  fill_parameters(cells);
  fill_primvars(cells);
}

void CellPoints::fill_geometry(std::span<const CellPoint> cells, const Camera& camera) {
  for (Vec3Array* array : {&P_, &N_, &I_, &dPdx_, &dPdy_, &dNdx_, &dNdy_})
    array->reset(points_.count);
  normal_variance_.resize(padded(cells.size()));
  for (int k = 0; k < points_.count; ++k) {
    const CellPoint& cell = cells[size_t(k)];
    const Grid& grid = *cell.grid;
    const VertexReader read(cell);
    glm::vec3 P, dPdx, dPdy;
    for (int axis = 0; axis < 3; ++axis) {
      P[axis] = read.value(grid.P(0, axis));
      const glm::vec2 dP = read.change(grid.P(0, axis));
      dPdx[axis] = dP.x, dPdy[axis] = dP.y;
    }
    CellNormal normal = cell_normal(cell);
    const glm::vec2 x = cell.footprint.ij_per_x, y = cell.footprint.ij_per_y;
    // The lattice may be seen from its other side; a footprint has no sign of its own.
    if ((x.x * y.y - x.y * y.x) * grid.normal_sign < 0.0f) dPdy = -dPdy, normal.dNdy = -normal.dNdy;
    P_.set(k, P), N_.set(k, normal.N), normal_variance_[size_t(k)] = normal.variance;
    I_.set(k, view_direction(camera, P));
    dPdx_.set(k, dPdx), dPdy_.set(k, dPdy), dNdx_.set(k, normal.dNdx), dNdy_.set(k, normal.dNdy);
  }
  points_.P = P_, points_.N = N_, points_.I = I_;
  points_.dPdx = dPdx_, points_.dPdy = dPdy_, points_.dNdx = dNdx_, points_.dNdy = dNdy_;
  points_.normal_variance = normal_variance_.data();
}

void CellPoints::fill_parameters(std::span<const CellPoint> cells) {
  const size_t stride = padded(cells.size());
  parameters_.assign(8 * stride, 0.0f);
  float* out = parameters_.data();
  for (size_t k = 0; k < cells.size(); ++k) {
    const Grid& grid = *cells[k].grid;
    const VertexReader read(cells[k]);
    const float *s = grid.st.data(), *t = s + grid.stride();
    const glm::vec2 ds = read.change(s), dt = read.change(t);
    const float values[] = {read.value(grid.uv.data()),
                            read.value(grid.uv.data() + grid.stride()),
                            read.value(s),
                            read.value(t),
                            ds.x,
                            dt.x,
                            ds.y,
                            dt.y};
    for (size_t p = 0; p < std::size(values); ++p) out[p * stride + k] = values[p];
  }
  const auto run = [&](size_t p) { return out + p * stride; };
  points_.u = run(0), points_.v = run(1), points_.s = run(2), points_.t = run(3);
  points_.st_footprint = {run(4), run(5), run(6), run(7)};
}

void CellPoints::fill_primvars(std::span<const CellPoint> cells) {
  const size_t stride = padded(cells.size());
  const std::vector<GridPrimvar>& first = cells.front().grid->primvars;
  for (size_t p = 0; p < first.size(); ++p) {
    AlignedVector<float>& values = primvars_.emplace_back(size_t(first[p].components) * stride);
    for (size_t k = 0; k < cells.size(); ++k) {
      const Grid& grid = *cells[k].grid;
      const VertexReader read(cells[k]);
      for (int c = 0; c < first[p].components; ++c)
        values[size_t(c) * stride + k] = read.value(grid.primvars[p].component(c, grid.stride()));
    }
    points_.primvars.push_back({first[p].source, first[p].components, values.data(), stride});
    if (first[p].components != 3) continue;
    const Vec3Input input = Vec3Input::varying(values.data(), stride);
    if (first[p].source->name == "Cs") points_.Cs = input;
    if (first[p].source->name == "Os") points_.Os = input;
  }
}

}  // namespace tessera
