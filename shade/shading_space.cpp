#include "shade/shading_space.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tessera {
namespace {

/// A cell reaches no farther over the surface than it would if the surface were seen this many
/// times less edge-on: as far as anisotropic texture filters go.
constexpr float most_foreshortening = 16.0f;

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  void add(double x) { low = std::min(low, x), high = std::max(high, x); }
};

}  // namespace

ShadingSpace::ShadingSpace(const Grid& grid, const Camera& camera,
                           const ShadingSpaceSettings& settings)
    : grid_(grid) {
  vertices_.u_count = grid.u_count, vertices_.v_count = grid.v_count;
  for (AlignedVector<float>* values : {&vertices_.x, &vertices_.y, &vertices_.w})
    values->resize(grid.stride());
  parametric_ = !place_vertices(camera, settings);
  if (parametric_) {
    place_parameters(settings.cells_per_edge);
  } else {
    charts_ = SpaceCharts(vertices_);
  }
}

/// False where some vertex has no place on the raster at shutter open, or one too far away for
/// cells to be counted.
bool ShadingSpace::place_vertices(const Camera& camera, const ShadingSpaceSettings& settings) {
  const RasterClipMap& map = camera.raster_clip();
  const float *Px = grid_.P(0, 0), *Py = grid_.P(0, 1), *Pz = grid_.P(0, 2);
  float *x = vertices_.x.data(), *y = vertices_.y.data(), *w = vertices_.w.data();
  const size_t count = size_t(grid_.vertex_count());
  bool placed = true;
  for (size_t i = 0; i < count; ++i) {
    w[i] = map.w_from_z * Pz[i] + map.w_constant;
    x[i] = map.x_scale * Px[i] / w[i] + map.x_from_w;
    y[i] = map.y_scale * Py[i] / w[i] + map.y_from_w;
    placed &= w[i] > 0.0f && std::abs(x[i]) < 1e9f && std::abs(y[i]) < 1e9f;
  }
  if (!placed || !fit_lattice(settings)) return false;
  const glm::vec2 ax(lattice_.x_axis), ay(lattice_.y_axis);
  const float ox = float(lattice_.offset.x), oy = float(lattice_.offset.y);
  for (size_t i = 0; i < count; ++i) {
    const float rx = x[i], ry = y[i];
    x[i] = ax.x * rx + ax.y * ry + ox;
    y[i] = ay.x * rx + ay.y * ry + oy;
  }
  return true;
}

/// Raster direction from the first to the last column of vertices.
glm::dvec2 ShadingSpace::mean_u_direction() const {
  glm::dvec2 sum(0);
  for (int j = 0; j <= grid_.v_count; ++j) {
    const size_t first = size_t(j * (grid_.u_count + 1)), last = first + size_t(grid_.u_count);
    sum +=
        glm::dvec2(vertices_.x[last] - vertices_.x[first], vertices_.y[last] - vertices_.y[first]);
  }
  const double length = glm::length(sum);
  return length > 0 ? sum / length : glm::dvec2(1, 0);
}

bool ShadingSpace::fit_lattice(const ShadingSpaceSettings& settings) {
  const ShadingExtents& e = settings.extents;
  const bool to_grid = settings.anchor == LatticeAnchor::grid;
  // Square cells may lie any way: along the grid its rim cuts fewest.
  const glm::dvec2 along =
      to_grid && e.d_mu == e.d_perp ? mean_u_direction() : glm::dvec2(e.direction);
  lattice_.x_axis = along * double(e.d_mu);
  lattice_.y_axis = glm::dvec2(-along.y, along.x) * double(e.d_perp);
  Range x, y;
  for (size_t i = 0; i < size_t(grid_.vertex_count()); ++i) {
    const glm::dvec2 at = lattice_.from_raster({vertices_.x[i], vertices_.y[i]});
    x.add(at.x), y.add(at.y);
  }
  const auto fit = [&](const Range& range, glm::dvec2& axis, double& offset, int& cells) {
    const double length = range.high - range.low;
    if (!(length < ShadingCell::most - 4)) return false;
    if (to_grid) {
      constexpr double rounding = 1e-4;
      cells = std::max(1, int(std::ceil(length - rounding)));
      // Not where the grid is next to nothing, and all of it in one cell anyway.
      const double stretch = length > 1e-3 ? std::max(1.0, cells / length) : 1.0;
      axis *= stretch;
      offset = (cells - stretch * (range.low + range.high)) / 2;
    } else {
      // Even, so that blocks of 2 x 2 cells lie the same way in every grid too.
      offset = -2 * std::floor(range.low / 2);
      cells = int(std::floor(range.high + offset)) + 1;
    }
    return true;
  };
  return fit(x, lattice_.x_axis, lattice_.offset.x, x_cells_) &&
         fit(y, lattice_.y_axis, lattice_.offset.y, y_cells_);
}

void ShadingSpace::place_parameters(int cells_per_edge) {
  const float n = float(cells_per_edge);
  for (int j = 0; j <= grid_.v_count; ++j) {
    for (int i = 0; i <= grid_.u_count; ++i) {
      const size_t k = size_t(j * (grid_.u_count + 1) + i);
      vertices_.x[k] = n * float(i), vertices_.y[k] = n * float(j), vertices_.w[k] = 1.0f;
    }
  }
  x_cells_ = grid_.u_count * cells_per_edge, y_cells_ = grid_.v_count * cells_per_edge;
}

void ShadingSpace::prepare_search() { index_.emplace(vertices_, charts_); }

glm::vec2 ShadingSpace::at(const SurfacePoint& point) const {
  const auto [a, b, c] = grid_.triangle_corners(point.triangle);
  const size_t A = size_t(a), B = size_t(b), C = size_t(c);
  const float wa = (1.0f - point.b1 - point.b2) * vertices_.w[A], wb = point.b1 * vertices_.w[B],
              wc = point.b2 * vertices_.w[C];
  const float per_w = 1.0f / (wa + wb + wc);
  return {(wa * vertices_.x[A] + wb * vertices_.x[B] + wc * vertices_.x[C]) * per_w,
          (wa * vertices_.y[A] + wb * vertices_.y[B] + wc * vertices_.y[C]) * per_w};
}

ShadingCell ShadingSpace::cell_of(const SurfacePoint& point) const {
  const glm::vec2 p = at(point);
  // Cut off before the conversion: a float beyond the integers, or NaN, has none.
  const auto whole = [](float x, int cells) {
    return int(std::floor(x > 0.0f ? std::min(x, float(cells - 1)) : 0.0f));
  };
  return {charts_.of(point.triangle), whole(p.x, x_cells_), whole(p.y, y_cells_)};
}

glm::ivec2 ShadingSpace::cell_over(const glm::vec2& raster) const {
  const glm::dvec2 p = glm::clamp(lattice_.from_raster(raster), -1e9, 1e9);
  return {int(std::floor(p.x)), int(std::floor(p.y))};
}

SurfacePoint ShadingSpace::shading_point(const ShadingCell& cell) const {
  // Half a diagonal: what touches no more than a corner of the cell may still be nearest.
  constexpr float reach = 0.7072f;
  return index_->nearest(cell.chart, float(cell.x) + 0.5f, float(cell.y) + 0.5f, reach);
}

CellFootprint ShadingSpace::footprint(const SurfacePoint& point) const {
  // Differences over up to three micropolygons: those at a rim may have collapsed.
  const int m = int(point.triangle / 2), row = grid_.u_count + 1;
  const int i = m % grid_.u_count, j = m / grid_.u_count;
  const int i0 = std::max(i - 1, 0), i1 = std::min(i + 2, grid_.u_count);
  const int j0 = std::max(j - 1, 0), j1 = std::min(j + 2, grid_.v_count);
  const auto difference = [&](int p, int q, int steps) {
    return glm::vec2(vertices_.x[size_t(q)] - vertices_.x[size_t(p)],
                     vertices_.y[size_t(q)] - vertices_.y[size_t(p)]) /
           float(steps);
  };
  const glm::vec2 per_i = difference(j * row + i0, j * row + i1, i1 - i0);
  const glm::vec2 per_j = difference(j0 * row + i, j1 * row + i, j1 - j0);
  const float determinant = per_i.x * per_j.y - per_i.y * per_j.x;
  const float least =
      std::max(glm::length(per_i) * glm::length(per_j) / most_foreshortening, 1e-30f);
  const float d = std::copysign(std::max(std::abs(determinant), least), determinant);
  CellFootprint footprint{{per_j.y / d, -per_i.y / d}, {-per_j.x / d, per_i.x / d}};
  const float farthest = float(std::max(grid_.u_count, grid_.v_count));
  for (glm::vec2* ij : {&footprint.ij_per_x, &footprint.ij_per_y}) {
    const float length = glm::length(*ij);
    if (!(length < farthest)) *ij = length < 1e30f ? *ij * (farthest / length) : glm::vec2(0.0f);
  }
  return footprint;
}

glm::vec2 ShadingSpace::raster_of(const SurfacePoint& point) const {
  return glm::vec2(lattice_.raster_from(glm::dvec2(at(point))));
}

}  // namespace tessera
