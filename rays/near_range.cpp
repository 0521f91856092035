#include "rays/near_range.h"

#include <algorithm>
#include <cmath>

#include <glm/glm.hpp>

namespace tessera {

namespace {

constexpr float safety = 2;
constexpr float triangle_over_side = 4.0f / 3;
/// Of the diameter of a micropolygon.
constexpr float reach_of_diameter = 2;

glm::vec3 vertex_P(const Grid& grid, int key, int vertex) {
  return {grid.P(key, 0)[vertex], grid.P(key, 1)[vertex], grid.P(key, 2)[vertex]};
}

glm::vec3 vertex_N(const Grid& grid, int vertex) {
  return {grid.N(0)[vertex], grid.N(1)[vertex], grid.N(2)[vertex]};
}

/// How far b is from halfway between a and c, across the line through them: uneven spacing along
/// a line is no bend.
float bend(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  const glm::vec3 difference = a - 2.0f * b + c, chord = c - a;
  const float length = glm::length(chord);
  return length > 0 ? glm::length(glm::cross(chord, difference)) / length : glm::length(difference);
}

/// The largest bend through each vertex, over all keys, along u and v.
std::vector<float> bends(const Grid& grid) {
  const int width = grid.u_count + 1, height = grid.v_count + 1;
  std::vector<float> most(size_t(width) * size_t(height), 0.0f);
  for (int key = 0; key < grid.key_count(); ++key) {
    for (int vertex = 0; vertex < width * height; ++vertex) {
      const int i = vertex % width, j = vertex / width;
      const auto along = [&](int step) {
        return bend(vertex_P(grid, key, vertex - step), vertex_P(grid, key, vertex),
                    vertex_P(grid, key, vertex + step));
      };
      float& here = most[size_t(vertex)];
      if (i > 0 && i + 1 < width) here = std::max(here, along(1));
      if (j > 0 && j + 1 < height) here = std::max(here, along(width));
    }
  }
  return most;
}

/// The corners a, b, c, d of a micropolygon.
using Corners = std::array<int, 4>;

/// From normals at shutter open: what a grid of one micropolygon has instead of bends.
float side_deviation(const Grid& grid, const Corners& corners) {
  constexpr int sides[5][2] = {{0, 1}, {0, 2}, {1, 3}, {2, 3}, {0, 3}};
  float most = 0;
  for (const auto& side : sides) {
    const int from = corners[size_t(side[0])], to = corners[size_t(side[1])];
    const glm::vec3 e = vertex_P(grid, 0, to) - vertex_P(grid, 0, from);
    most = std::max(most, std::abs(glm::dot(vertex_N(grid, to) - vertex_N(grid, from), e)) / 8);
  }
  return most;
}

}  // namespace

std::vector<NearRange> near_ranges(const Grid& grid) {
  const std::vector<float> bend_at = bends(grid);
  const float bend_weight = grid.attributes().displacement ? 1.0f : 1.0f / 8;
  std::vector<NearRange> ranges(size_t(grid.micropolygon_count()));
  for (uint32_t m = 0; m < ranges.size(); ++m) {
    const auto first = grid.triangle_corners(2 * m), second = grid.triangle_corners(2 * m + 1);
    const Corners corners{first[0], first[1], second[2], first[2]};
    float twist = 0, diameter = 0, bent = 0;
    for (int key = 0; key < grid.key_count(); ++key) {
      const glm::vec3 a = vertex_P(grid, key, corners[0]), b = vertex_P(grid, key, corners[1]),
                      c = vertex_P(grid, key, corners[2]), d = vertex_P(grid, key, corners[3]);
      twist = std::max(twist, glm::length(a - b - c + d) / 4);
      diameter = std::max({diameter, glm::length(b - a), glm::length(c - a), glm::length(d - b),
                           glm::length(d - c), glm::length(d - a), glm::length(c - b)});
    }
    for (int corner : corners) bent = std::max(bent, bend_at[size_t(corner)]);
    const float side = std::max(side_deviation(grid, corners), bent * bend_weight);
    ranges[m].height = safety * std::max(twist, triangle_over_side * side);
    ranges[m].reach = reach_of_diameter * diameter;
  }
  return ranges;
}

}  // namespace tessera
