#pragma once
/// The extremes table, rays: coordinates of all sizes, scenes far from the origin, surfaces that
/// lie in one another or have no area, and directions of any length.

#include <random>

#include <glm/gtc/matrix_transform.hpp>

#include "bench/extremes_table.h"
#include "tests/rays/ray_scene.h"

namespace tessera {

inline glm::vec3 point_in_box(std::mt19937& random, float half) {
  std::uniform_real_distribution<float> x(-half, half);
  const float a = x(random), b = x(random), c = x(random);
  return {a, b, c};
}

inline Attributes blocker(float opacity) {
  Attributes attributes;
  attributes.opacity = glm::vec3(opacity);
  return attributes;
}

/// Bent patches about `centre`, their sizes about `unit`.
inline void add_bent_patches(test::DiceScene& scene, std::mt19937& random, float unit,
                             const glm::vec3& centre) {
  for (int k = 0; k < 12; ++k) {
    const glm::vec3 middle = point_in_box(random, 6);
    std::vector<glm::vec3> points;
    for (int i = 0; i < 16; ++i) {
      const glm::vec3 corner(float(i % 4) - 1.5f, float(i / 4) - 1.5f, 0);
      points.push_back(centre + unit * (middle + corner + point_in_box(random, 0.5f)));
    }
    scene.add(test::geometry(test::bicubic_mesh(), std::move(points)));
  }
}

/// Distances to the nearest of all triangles; rays near an edge, and those that begin on a surface as
/// far as the tracer tells, are left out.
inline WorstError nearest_errors(const RayTracer& tracer, std::mt19937& random, int count,
                                 float unit, const glm::vec3& centre, float length) {
  WorstError error;
  for (int k = 0; k < count; ++k) {
    const glm::vec3 origin = centre + unit * point_in_box(random, 8);
    const glm::vec3 direction = length * point_in_box(random, 1);
    const auto all = test::meetings(tracer, origin, direction, 0);
    if (std::ranges::any_of(all, [](const auto& m) { return std::abs(m.margin) < 1e-2L; }))
      continue;
    const float found = test::closest(tracer, test::one_ray(origin, direction)).distance[0];
    // What a float can hold of the place: its rounding, and what it is in lengths of the ray.
    const long double away = glm::length(test::TestPoint(centre));
    const long double step = glm::length(test::TestPoint(direction));
    // Surfaces are met from a distance on that follows from the coordinates (docs/rays.md, Where a
    // ray begins): nearer ones may be what it begins on.
    const auto starts_on = [&](long double t) { return t * step < 5e-6L * (away + 8 * unit); };
    if (starts_on(found) || (!all.empty() && starts_on(all.front().t))) continue;
    if (all.empty() || !std::isfinite(found)) {
      error.see(all.empty() == !std::isfinite(found) ? 0.0 : INFINITY);
      continue;
    }
    error.see(found * step, all.front().t * step, all.front().t * step + away);
  }
  return error;
}

inline void add_nearest_extremes(ExtremesTable& table) {
  struct Case {
    const char* name;
    float unit;
    glm::vec3 centre;
    float length;
  };
  const glm::vec3 here(0.0f);
  for (const Case& c : {Case{"coordinates 1e-15", 1e-15f, here, 1},
                        {"coordinates 1e-6", 1e-6f, here, 1},
                        {"coordinates 1e7", 1e7f, here, 1},
                        {"coordinates 1e13", 1e13f, here, 1},
                        {"1e4 sizes from the origin", 1, {1e4f, -5e3f, 2e4f}, 1},
                        {"directions 1e-30 long", 1, here, 1e-30f},
                        {"directions 1e30 long", 1, here, 1e30f}}) {
    std::mt19937 random(3);
    test::DiceScene scene;
    RaySettings settings;
    settings.dicing_rate = 160.0f;
    add_bent_patches(scene, random, c.unit, c.centre);
    const auto tracer = test::tracer_of(scene, settings);
    table.add(
        {"rays", c.name, "all triangles, long double",
         nearest_errors(*tracer, random, table.scaled(20000, 1000), c.unit, c.centre, c.length),
         "of distance and place", 2e-5});
  }
}

/// Squares in one plane: light passes the product over all, and the first is what is met.
inline void add_coincident_squares(ExtremesTable& table) {
  for (const float unit : {1e-6f, 1.0f, 1e7f}) {
    test::DiceScene scene;
    PatchMesh mesh = test::bicubic_mesh(2, 2);
    mesh.bicubic = false;
    const glm::dmat4 place = glm::scale(glm::dmat4(1), glm::dvec3(double(unit)));
    for (const float opacity : {0.25f, 0.5f, 0.75f})
      scene.add(test::geometry(mesh, {{-1, -1, 4}, {1, -1, 4}, {-1, 1, 4}, {1, 1, 4}}), place,
                blocker(opacity));
    const auto tracer = test::tracer_of(scene);
    std::mt19937 random(7);
    WorstError error;
    for (int k = 0; k < table.scaled(20000, 2000); ++k) {
      glm::vec3 at = point_in_box(random, 0.999f);
      at.z = 4;
      if (k % 2) at.y = at.x;  // along the diagonals of micropolygons
      const Rays ray = test::one_ray(glm::vec3(0.0f), 2.0f * unit * at, 1);
      error.see(double(test::shadow(*tracer, ray).share[0]), 0.75L * 0.5L * 0.25L);
      const RayHits hits = test::closest(*tracer, ray);
      const bool met = std::isfinite(hits.distance[0]);
      error.see(met && tracer->grids()[hits.grid[0]]->id.surface == 0 ? 0.0 : 1.0);
    }
    table.add({"rays", fmt::format("three surfaces in one plane, unit {:g}", unit),
               "product of 1 - opacity; first met", error, "of the light", 1e-6});
  }
}

/// From inside a closed surface no ray may escape: in any direction, or to a place on an edge
/// where two triangles meet. At a vertex, where six do, rounding may leave a gap.
inline void add_escapes(ExtremesTable& table) {
  for (const double unit : {1e-6, 1.0, 1e7}) {
    test::DiceScene scene;
    const glm::dmat4 away = glm::translate(glm::dmat4(1), glm::dvec3(0, 0, 2) * unit);
    scene.add(test::geometry(test::cube_cage(), test::cube_points()),
              glm::scale(away, glm::dvec3(unit)));
    const auto tracer = test::tracer_of(scene);
    const glm::vec3 origin(0, 0, 2 * float(unit));
    const auto escapes = [&](const glm::vec3& direction) {
      return std::isfinite(test::closest(*tracer, test::one_ray(origin, direction)).distance[0])
                 ? 0.0
                 : 1.0;
    };
    std::mt19937 random(8);
    WorstError of_vertices, error;
    double vertices = 0, escaped = 0;
    for (int k = 0; k < table.scaled(200000, 20000); ++k)
      error.see(escapes(point_in_box(random, 1)));
    for (const auto& grid : tracer->grids()) {
      for (uint32_t m = 0; m < uint32_t(grid->micropolygon_count()); ++m) {
        const auto corners = grid->triangle_corners(2 * m);
        const glm::vec3 a(test::vertex_at(*grid, corners[0], 0.0f));
        const glm::vec3 d(test::vertex_at(*grid, corners[2], 0.0f));
        for (const float share : {0.1f, 0.25f, 0.5f})
          error.see(escapes(glm::mix(a, d, share) - origin));
        ++vertices, escaped += escapes(a - origin);
      }
    }
    table.add({"rays", fmt::format("inside a closed surface, unit {:g}", unit),
               "every ray meets it", error, "escaped", 0});
    of_vertices.see(escaped / vertices);
    table.add({"rays", fmt::format("inside, at vertices, unit {:g}", unit), "every ray meets it",
               of_vertices, "share escaped", 1e-2,
               fmt::format("{} of {} vertices", escaped, vertices)});
  }
}

/// Patches without area before a wall, and rays without direction or with numbers that are none.
inline void add_nothing_to_meet(ExtremesTable& table) {
  test::DiceScene scene;
  PatchMesh mesh = test::bicubic_mesh(2, 2);
  mesh.bicubic = false;
  scene.add(test::geometry(mesh, {{0, 0, 2}, {0, 0, 2}, {0, 0, 2}, {0, 0, 2}}));
  scene.add(test::geometry(mesh, {{-1, 0, 2}, {1, 0, 2}, {-1, 0, 2}, {1, 0, 2}}));
  scene.add(test::geometry(mesh, {{-9, -9, 4}, {9, -9, 4}, {-9, 9, 4}, {9, 9, 4}}));
  const auto tracer = test::tracer_of(scene);
  std::mt19937 random(9);
  WorstError error, none;
  for (int k = 0; k < table.scaled(20000, 2000); ++k) {
    glm::vec3 direction = point_in_box(random, 1);
    direction.z = 1;
    if (k % 2) direction.y = 0;  // in the plane of the line
    if (k % 10 == 0) direction.x = 0;
    const RayHits hits = test::closest(*tracer, test::one_ray(glm::vec3(0.0f), direction));
    error.see(hits.distance[0], 4, 4);
  }
  table.add({"rays", "triangles without area before a wall", "the wall's plane", error,
             "of the distance", 2e-6});
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const glm::vec3& direction : {glm::vec3(0.0f), {nan, 0, 1}, {0, nan, nan}}) {
    const Rays ray = test::one_ray(glm::vec3(0.0f), direction);
    none.see(std::isfinite(test::closest(*tracer, ray).distance[0]) ? 1.0 : 0.0);
    none.see(double(test::shadow(*tracer, ray).share[0]), 1);
  }
  table.add({"rays", "directions 0 and NaN", "nothing is met", none, "met", 0});
}

inline void add_ray_extremes(ExtremesTable& table) {
  add_nearest_extremes(table);
  add_coincident_squares(table);
  add_escapes(table);
  add_nothing_to_meet(table);
}

}  // namespace tessera
