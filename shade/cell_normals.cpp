#include "shade/cell_normals.h"

#include <algorithm>
#include <cmath>

#include "shade/mathematics.h"
#include "shade/vertex_reader.h"

namespace tessera {
namespace {

/// Normals along each axis of a cell, at most.
constexpr int most_normals = 8;
/// Cells up to this many micropolygons long hold no bumps of their own.
constexpr float small_cell = 1.5f;

/// Place in the grid, in micropolygons.
glm::vec2 place_of(const CellPoint& cell) {
  const uint32_t m = cell.at.triangle / 2, columns = uint32_t(cell.grid->u_count);
  const glm::vec2 corner(float(m % columns), float(m / columns));
  const float b1 = cell.at.b1, b2 = cell.at.b2;
  // Triangles (a, b, d) and (a, d, c).
  return corner + (cell.at.triangle % 2 == 0 ? glm::vec2(b1 + b2, b2) : glm::vec2(b1, b1 + b2));
}

glm::vec3 normal_at(const Grid& grid, const glm::vec2& place) {
  const int i = int(std::lround(std::clamp(place.x, 0.0f, float(grid.u_count))));
  const int j = int(std::lround(std::clamp(place.y, 0.0f, float(grid.v_count))));
  const size_t k = size_t(j * (grid.u_count + 1) + i);
  return {grid.N(0)[k], grid.N(1)[k], grid.N(2)[k]};
}

int taps_over(float micropolygons) {
  return int(std::clamp(std::ceil(micropolygons), 1.0f, float(most_normals)));
}

/// Middle of the k-th of n parts of a cell's axis, from -1/2 to 1/2.
float tap(int k, int n) { return (float(k) + 0.5f) / float(n) - 0.5f; }

/// Mean of tap()^2.
float mean_square(int n) { return (1.0f - 1.0f / float(n * n)) / 12.0f; }

CellNormal interpolated(const CellPoint& cell) {
  const VertexReader read(cell);
  CellNormal result;
  for (int axis = 0; axis < 3; ++axis) {
    result.N[axis] = read.value(cell.grid->N(axis));
    const glm::vec2 change = read.change(cell.grid->N(axis));
    result.dNdx[axis] = change.x, result.dNdy[axis] = change.y;
  }
  result.N = unit_or_zero(result.N);
  return result;
}

}  // namespace

CellNormal cell_normal(const CellPoint& cell) {
  const glm::vec2 x = cell.footprint.ij_per_x, y = cell.footprint.ij_per_y;
  if (glm::length(x) <= small_cell && glm::length(y) <= small_cell) return interpolated(cell);
  const int nx = taps_over(glm::length(x)), ny = taps_over(glm::length(y));
  const glm::vec2 centre = place_of(cell);
  glm::vec3 sum(0.0f), along_x(0.0f), along_y(0.0f);
  for (int b = 0; b < ny; ++b) {
    for (int a = 0; a < nx; ++a) {
      const float at_x = tap(a, nx), at_y = tap(b, ny);
      const glm::vec3 N = normal_at(*cell.grid, centre + at_x * x + at_y * y);
      sum += N, along_x += at_x * N, along_y += at_y * N;
    }
  }
  const float count = float(nx * ny), length = glm::length(sum) / count;
  if (!(length > 1e-3f)) return interpolated(cell);  // they cancel: the cell goes around something
  CellNormal result;
  result.N = sum / (count * length);
  if (nx > 1) result.dNdx = along_x / (count * mean_square(nx));
  if (ny > 1) result.dNdy = along_y / (count * mean_square(ny));
  // The mean of |N - mean|^2 over unit vectors, less the part that the change accounts for.
  const float linear = glm::dot(result.dNdx, result.dNdx) * mean_square(nx) +
                       glm::dot(result.dNdy, result.dNdy) * mean_square(ny);
  result.variance = std::max(0.0f, 1.0f - length * length - linear);
  return result;
}

}  // namespace tessera
