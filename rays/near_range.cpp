#include "rays/near_range.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/glm.hpp>

namespace tessera {

namespace {

/// A surface that deviates by d over the diameter D has curvature 8 d / D^2, and at 1.1 D from
/// where it touches a plane it is 4.84 d away from it; micropolygons are another d beside it.
constexpr double height_of_deviation = 6;
constexpr double triangle_over_side = 4.0 / 3;
constexpr double eighth = 1.0 / 8;
/// Of the diameter of a micropolygon: what is above or below it and meets it is no farther away.
constexpr double reach_of_diameter = 1.1;

/// The vertices a, b, c, d of a micropolygon.
using Corners = std::array<int, 4>;

Corners corners_of(const Grid& grid, uint32_t micropolygon) {
  const auto first = grid.triangle_corners(2 * micropolygon);
  const auto second = grid.triangle_corners(2 * micropolygon + 1);
  return {first[0], first[1], second[2], first[2]};
}

// In double: products of tiny or huge lengths leave the range of float.
glm::dvec3 P_at(const Grid& grid, int key, int vertex) {
  return {grid.P(key, 0)[vertex], grid.P(key, 1)[vertex], grid.P(key, 2)[vertex]};
}

/// Difference of the normals at two vertices, at shutter open.
glm::dvec3 turn(const Grid& grid, int from, int to) {
  const auto N = [&](int vertex) {
    return glm::dvec3(grid.N(0)[vertex], grid.N(1)[vertex], grid.N(2)[vertex]);
  };
  return N(to) - N(from);
}

/// A micropolygon at one key.
class Measures {
 public:
  Measures(const Grid& grid, int key, const Corners& corners)
      : grid_(grid), key_(key), corners_(corners) {
    for (size_t c = 0; c < 4; ++c) P_[c] = P_at(grid, key, corners[c]);
    const glm::dvec3 across = glm::cross(P_[3] - P_[0], P_[2] - P_[1]);
    const double area = glm::length(across);
    if (area > 0) normal_ = across / area;
  }

  double diameter() const {
    double most = 0;
    for (const auto& s : sides) most = std::max(most, glm::length(P_[s[1]] - P_[s[0]]));
    return std::max(most, glm::length(P_[2] - P_[1]));
  }

  // Off the plane only: vertices on edges of grids are moved along the surface, and that is no
  // bend.
  double twist() const { return std::abs(glm::dot(P_[0] - P_[1] - P_[2] + P_[3], normal_)); }

  /// The largest second difference at the corners, along u and v.
  double bend() const {
    const int width = grid_.u_count + 1;
    double most = 0;
    for (int corner : corners_) {
      const int i = corner % width, j = corner / width;
      if (i > 0 && i < grid_.u_count) most = std::max(most, second_difference(corner, 1));
      if (j > 0 && j < grid_.v_count) most = std::max(most, second_difference(corner, width));
    }
    return most;
  }

  /// What the normals say along the sides and the diagonal: what a grid of one micropolygon has
  /// instead of second differences. At shutter open.
  double turn_along_sides() const {
    double most = 0;
    for (const auto& s : sides) {
      const glm::dvec3 turned = turn(grid_, corners_[s[0]], corners_[s[1]]);
      most = std::max(most, std::abs(glm::dot(turned, P_[s[1]] - P_[s[0]])));
    }
    return most;
  }

 private:
  static constexpr size_t sides[5][2] = {{0, 1}, {0, 2}, {1, 3}, {2, 3}, {0, 3}};

  double second_difference(int vertex, int step) const {
    const glm::dvec3 before = P_at(grid_, key_, vertex - step), here = P_at(grid_, key_, vertex),
                     after = P_at(grid_, key_, vertex + step);
    return std::abs(glm::dot(before - 2.0 * here + after, normal_));
  }

  const Grid& grid_;
  const int key_;
  const Corners& corners_;
  std::array<glm::dvec3, 4> P_;
  glm::dvec3 normal_{0};
};

}  // namespace

std::vector<NearRange> near_ranges(const Grid& grid) {
  // Polygons are flat, whatever their normals pretend.
  const bool flat = std::holds_alternative<PolygonMesh>(grid.surface->geometry->shape) &&
                    !grid.attributes().displacement;
  std::vector<NearRange> ranges(size_t(grid.micropolygon_count()));
  for (uint32_t m = 0; m < ranges.size(); ++m) {
    const Corners corners = corners_of(grid, m);
    double twist = 0, diameter = 0, side = 0;
    for (int key = 0; key < grid.key_count(); ++key) {
      const Measures at(grid, key, corners);
      twist = std::max(twist, at.twist() / 4);
      side = std::max(side, at.bend() * eighth);
      if (key == 0 && !flat) side = std::max(side, at.turn_along_sides() * eighth);
      diameter = std::max(diameter, at.diameter());
    }
    ranges[m].height = float(height_of_deviation * std::max(twist, triangle_over_side * side));
    ranges[m].reach = float(reach_of_diameter * diameter);
  }
  return ranges;
}

}  // namespace tessera
