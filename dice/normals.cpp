#include "dice/normals.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "dice/bicubic_kernel.h"

namespace tessera {

namespace {

glm::dvec3 vector_at(float* const N[3], int vertex) {
  return {N[0][vertex], N[1][vertex], N[2][vertex]};
}

void set_vector(float* const N[3], int vertex, const glm::dvec3& value) {
  for (int axis = 0; axis < 3; ++axis) N[axis][vertex] = float(value[axis]);
}

// Normalises in double; false (and zero) when there is no direction.
bool normalize(float* const N[3], int vertex) {
  const glm::dvec3 n = vector_at(N, vertex);
  const double length = glm::length(n);
  const bool good = length > 0 && std::isfinite(length);
  set_vector(N, vertex, good ? n / length : glm::dvec3(0));
  return good;
}

// One pass of filling unknown vertices from the known among their eight neighbours.
bool fill_once(const Grid& grid, float* const N[3], std::vector<char>& known) {
  const std::vector<char> before = known;
  const int width = grid.u_count + 1, height = grid.v_count + 1;
  bool progress = false;
  for (int j = 0; j < height; ++j) {
    for (int i = 0; i < width; ++i) {
      const int vertex = j * width + i;
      if (before[size_t(vertex)]) continue;
      glm::dvec3 sum(0);
      for (int y = std::max(j - 1, 0); y <= std::min(j + 1, height - 1); ++y) {
        for (int x = std::max(i - 1, 0); x <= std::min(i + 1, width - 1); ++x) {
          if (before[size_t(y * width + x)]) sum += vector_at(N, y * width + x);
        }
      }
      set_vector(N, vertex, sum);
      if (normalize(N, vertex)) known[size_t(vertex)] = 1, progress = true;
    }
  }
  return progress;
}

}  // namespace

void normals_from_positions(const Grid& grid, int key, float* const N[3]) {
  const int width = grid.u_count + 1, height = grid.v_count + 1;
  const auto at = [&](int i, int j) {
    const int k = j * width + i;
    return glm::vec3(grid.P(key, 0)[k], grid.P(key, 1)[k], grid.P(key, 2)[k]);
  };
  for (int j = 0; j < height; ++j) {
    for (int i = 0; i < width; ++i) {
      // A boundary vertex may lie on its neighbour along the edge: reach on until it does not.
      int i0 = std::max(i - 1, 0), i1 = std::min(i + 1, width - 1);
      int j0 = std::max(j - 1, 0), j1 = std::min(j + 1, height - 1);
      while (i0 > 0 && at(i0, j) == at(i, j)) --i0;
      while (i1 < width - 1 && at(i1, j) == at(i, j)) ++i1;
      while (j0 > 0 && at(i, j0) == at(i, j)) --j0;
      while (j1 < height - 1 && at(i, j1) == at(i, j)) ++j1;
      const glm::vec3 n = glm::cross(at(i1, j) - at(i0, j), at(i, j1) - at(i, j0));
      for (int axis = 0; axis < 3; ++axis) N[axis][j * width + i] = n[axis];
    }
  }
}

void make_unit_normals(const Grid& grid, float* const N[3], float sign) {
  const int count = grid.vertex_count();
  if (normalize_normals(N, size_t(count), sign)) return;
  std::vector<char> known(static_cast<size_t>(count));
  int missing = 0;
  for (int k = 0; k < count; ++k) {
    known[size_t(k)] = normalize(N, k);
    missing += known[size_t(k)] ? 0 : 1;
  }
  if (missing == count) {
    normals_from_positions(grid, 0, N);
    for (int k = 0; k < count; ++k) {
      set_vector(N, k, vector_at(N, k) * double(sign));
      known[size_t(k)] = normalize(N, k);
    }
  }
  while (std::count(known.begin(), known.end(), 0) > 0 && fill_once(grid, N, known)) {
  }
  for (int k = 0; k < count; ++k) {
    if (!known[size_t(k)]) set_vector(N, k, {0, 0, -1});
  }
}

}  // namespace tessera
