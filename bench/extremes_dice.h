#pragma once
/// The extremes table, dice: patches without area, rates and coordinates over many orders of
/// magnitude, closed surfaces.

#include <array>
#include <map>
#include <random>

#include <glm/gtc/matrix_transform.hpp>

#include "bench/extremes_dice_eye.h"
#include "dice/whole_scene.h"
#include "tests/dice/dice_scene.h"

namespace tessera {

inline LongVec position(const Grid& grid, int vertex, int key = 0) {
  return {grid.P(key, 0)[vertex], grid.P(key, 1)[vertex], grid.P(key, 2)[vertex]};
}

/// Patches whose points all lie on the line from `a` to `b`, or all in `a`.
inline void add_zero_area_patches(ExtremesTable& table) {
  const glm::vec3 a(-0.3f, 0.2f, 3.0f);
  for (const auto& [name, b] : {std::pair{"in a point", a}, {"on a line", {0.9f, -0.4f, 5.0f}}}) {
    WorstError error;
    for (const bool bicubic : {false, true}) {
      test::DiceScene s;
      PatchMesh mesh = test::bicubic_mesh();
      mesh.bicubic = bicubic;
      if (!bicubic) mesh.u_vertices = mesh.v_vertices = 2;
      std::mt19937 random(1);
      std::uniform_real_distribution<float> share(0, 1);
      std::vector<glm::vec3> points(bicubic ? 16 : 4);
      for (glm::vec3& p : points) p = glm::mix(a, b, share(random));
      s.add(test::geometry(mesh, points));
      for (const auto& grid : s.all_grids()) {
        for (int k = 0; k < grid->vertex_count(); ++k) {
          const LongVec from_a = position(*grid, k) - LongVec(a), along = LongVec(b) - LongVec(a);
          const long double length = glm::length(along);
          error.see(double(length > 0 ? glm::length(glm::cross(from_a, along)) / length
                                      : glm::length(from_a)));
          for (int axis = 0; axis < 3; ++axis) error.see(0.0 * double(grid->N(axis)[k]));
        }
      }
    }
    table.add({"dice", fmt::format("patches with all points {}", name), "the line; normals finite",
               error, "units at depth 3 to 5", 1e-6});
  }
}

/// Spheres, whose vertices all lie at one distance from the centre.
inline void add_sphere_extremes(ExtremesTable& table) {
  struct Case {
    const char* name;
    double radius;
    float rate;
  };
  for (const Case& c : {Case{"micropolygons of 1e-2 pixels^2", 1, 1e-2f},
                        {"micropolygons of 1e12 pixels^2", 1, 1e12f},
                        {"coordinates 1e-6", 1e-6, 1},
                        {"coordinates 1e7", 1e7, 1},
                        {"coordinates 1e15", 1e15, 1}}) {
    test::DiceScene s(320, 240);
    s.scene.camera.near_clip = 0.01 * c.radius;
    s.settings.dicing_rate = c.rate;
    const Quadric ball{Quadric::Kind::sphere, {{1, -1, 1, 360}}};
    const glm::dmat4 away = glm::translate(glm::dmat4(1), glm::dvec3(0.5, 0.25, 6) * c.radius);
    s.add(test::geometry(ball), glm::scale(away, glm::dvec3(c.radius)));
    const LongVec centre = LongVec(0.5L, 0.25L, 6) * (long double)(c.radius);
    WorstError error;
    for (const auto& grid : s.all_grids())
      for (int k = 0; k < grid->vertex_count(); ++k)
        error.see(glm::length(position(*grid, k) - centre), c.radius, c.radius);
    table.add({"dice", fmt::format("sphere, {}", c.name), "distance from the centre", error,
               "of the radius", 5e-6});
  }
}

/// Edges of triangles with no reverse in another triangle, at all keys; every bit of every vertex
/// counts.
inline WorstError open_edges(const test::Grids& grids) {
  using Place = std::array<float, 3>;
  WorstError error;
  for (int key = 0; !grids.empty() && key < grids[0]->key_count(); ++key) {
    std::map<std::pair<Place, Place>, int> balance;
    for (const auto& grid : grids) {
      for (uint32_t k = 0; k < 2 * uint32_t(grid->micropolygon_count()); ++k) {
        const auto corners = grid->triangle_corners(k);
        for (size_t e = 0; e < 3; ++e) {
          Place p, q;
          for (int axis = 0; axis < 3; ++axis) {
            p[size_t(axis)] = grid->P(key, axis)[corners[e]] + 0.0f;
            q[size_t(axis)] = grid->P(key, axis)[corners[(e + 1) % 3]] + 0.0f;
          }
          if (p < q) ++balance[{p, q}];
          if (q < p) --balance[{q, p}];
        }
      }
    }
    for (const auto& edge : balance) error.see(edge.second == 0 ? 0.0 : 1.0);
  }
  return error;
}

/// A torus as a closed mesh, at 0.1 to 1e7 times the unit, about the eye or before it.
inline void add_closed_extremes(ExtremesTable& table) {
  struct Case {
    const char* name;
    double scale, depth, far_away;
  };
  for (const Case& c : {Case{"torus of 1e-6", 1e-6, 4, 0},
                        {"torus of 1e7", 1e7, 4, 0},
                        {"torus 1e5 sizes off the axis", 1, 4, 1e5},
                        {"torus through the eye plane", 1, 0, 0},
                        {"torus with the eye on it", 1, 0, 1.4}}) {
    test::DiceScene s;
    s.scene.camera.near_clip = 0.01 * c.scale;
    s.settings.dicing_rate = table.quick() ? 16.0f : 2.0f;
    glm::dmat4 m = glm::scale(glm::dmat4(1), glm::dvec3(c.scale));
    m = glm::translate(m, glm::dvec3(c.far_away, 0, c.depth));
    const glm::dmat4 turned = glm::rotate(m, 0.7, glm::dvec3(0.3, 1, 0.2));
    Surface& surface = s.add(test::geometry(test::torus_cage(6, 5), test::torus_points(6, 5)));
    surface.world_from_object = MovingTransform({0, 1}, {m, turned});
    s.scene.camera.shutter_close = 1;
    const Camera camera(s.scene.camera);
    table.add({"dice", c.name, "every edge has its reverse, bit for bit",
               open_edges(dice_whole_scene(s.scene, camera, s.settings, s.diagnostics)),
               "open edges", 0});
  }
}

inline void add_dice_extremes(ExtremesTable& table) {
  add_zero_area_patches(table);
  add_sphere_extremes(table);
  add_closed_extremes(table);
  add_eye_extremes(table);
}

}  // namespace tessera
