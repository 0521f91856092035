// Shading normals of displaced surfaces where grids meet.

#include <array>
#include <cmath>
#include <functional>

#include <catch2/catch.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "tests/dice/dice_scene.h"

namespace tessera::test {
namespace {

const glm::dvec3 centre(0.1, -0.2, 5.0);

glm::dmat4 placement() {
  return glm::rotate(glm::translate(glm::dmat4(1), centre), 0.8, glm::dvec3(0.3, 1, 0.2));
}

double waves(const glm::dvec3& p) {
  return 0.06 * std::sin(7 * p.x + 5 * p.y) + 0.03 * std::cos(11 * p.z);
}

// Distances from the position alone, or from all that a displacement shader may read.
class Waves final : public Displacer {
 public:
  void displace(const Grid& grid, std::span<float> distance) const override {
    for (int k = 0; k < grid.vertex_count(); ++k) {
      distance[size_t(k)] = float(waves({grid.P(0, 0)[k], grid.P(0, 1)[k], grid.P(0, 2)[k]}));
    }
  }
};

class Bumps final : public Displacer {
 public:
  void displace(const Grid& grid, std::span<float> distance) const override {
    for (int k = 0; k < grid.vertex_count(); ++k) {
      const float x = grid.P(0, 0)[k], y = grid.P(0, 1)[k], n = grid.N(0)[k];
      distance[size_t(k)] = 0.06f * std::sin(9.0f * x + 7.0f * y) + 0.03f * n;
    }
  }
};

Grids displaced(const Geometry& g, const Displacer& displacer, int max_grid_size = 16) {
  DiceScene s(200, 200);
  Attributes attributes;
  attributes.displacement.emplace();
  attributes.displacement_bound = 0.2f;
  s.settings.displacer = &displacer;
  s.settings.max_grid_size = max_grid_size;
  s.add(g, placement(), attributes);
  Grids grids = s.all_grids();
  CHECK(s.diagnostics.lines().empty());
  return grids;
}

glm::dvec3 position(const Grid& grid, int k) {
  return {grid.P(0, 0)[k], grid.P(0, 1)[k], grid.P(0, 2)[k]};
}

glm::dvec3 normal(const Grid& grid, int k) { return {grid.N(0)[k], grid.N(1)[k], grid.N(2)[k]}; }

double degrees_between(const glm::dvec3& a, const glm::dvec3& b) {
  return glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

bool on_boundary(const Grid& grid, int k) {
  const int width = grid.u_count + 1, i = k % width, j = k / width;
  return i == 0 || i == grid.u_count || j == 0 || j == grid.v_count;
}

struct Seams {
  int vertices = 0;    ///< that more than one grid has
  double largest = 0;  ///< angle between two grids' normals at one vertex, degrees
};

Seams seams(const Grids& grids, const std::function<bool(const glm::dvec3&)>& counts) {
  std::map<std::array<double, 3>, std::vector<glm::dvec3>> found;
  for (const auto& grid : grids) {
    std::map<std::array<double, 3>, glm::dvec3> once;
    for (int k = 0; k < grid->vertex_count(); ++k) {
      const glm::dvec3 p = position(*grid, k);
      if (on_boundary(*grid, k) && counts(p)) once[{p.x, p.y, p.z}] = normal(*grid, k);
    }
    for (const auto& [p, n] : once) found[p].push_back(n);
  }
  Seams result;
  for (const auto& entry : found) {
    const std::vector<glm::dvec3>& normals = entry.second;
    result.vertices += normals.size() > 1;
    for (const glm::dvec3& n : normals) {
      result.largest = std::max(result.largest, degrees_between(n, normals[0]));
    }
  }
  return result;
}

bool anywhere(const glm::dvec3&) { return true; }

// A sphere has no two directions at its poles; the normals there are each grid's own.
bool off_the_poles(const glm::dvec3& p) {
  const glm::dvec3 object = glm::inverse(placement()) * glm::dvec4(p, 1);
  return std::hypot(object.x, object.y) > 0.02;
}

const Quadric sphere{Quadric::Kind::sphere, {{1.0, -1.0, 1.0, 360.0}}};

TEST_CASE("grids of a displaced surface agree on normals where they meet", "[dice][displacement]") {
  const Bumps bumps;
  for (const int most : {16, 7}) {
    INFO("grids of up to " << most);
    const Seams ball = seams(displaced(geometry(sphere), bumps, most), off_the_poles);
    CHECK(ball.vertices > 500);
    CHECK(ball.largest < 0.01);
    const Seams cube =
        seams(displaced(geometry(cube_cage(), cube_points()), bumps, most), anywhere);
    CHECK(cube.vertices > 500);
    CHECK(cube.largest < 0.01);
    const Seams torus =
        seams(displaced(geometry(torus_cage(7, 5), torus_points(7, 5)), bumps, most), anywhere);
    CHECK(torus.vertices > 500);
    CHECK(torus.largest < 0.01);
  }
}

// The displaced sphere is the zero set of |x| - 1 - waves(x / |x|); its normal, the gradient.
glm::dvec3 true_normal(const glm::dvec3& p) {
  const auto value = [](const glm::dvec3& x) {
    const double r = glm::length(x - centre);
    return r - waves(centre + (x - centre) / r);
  };
  glm::dvec3 gradient;
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 h(0);
    h[axis] = 1e-5;
    gradient[axis] = value(p + h) - value(p - h);
  }
  return glm::normalize(gradient);
}

TEST_CASE("normals of a displaced sphere are as good at grids' borders as inside",
          "[dice][displacement]") {
  const Waves displacer;
  double inside = 0, border = 0;  // mean squares
  int inner = 0, outer = 0;
  for (const auto& grid : displaced(geometry(sphere), displacer)) {
    for (int k = 0; k < grid->vertex_count(); ++k) {
      const glm::dvec3 p = position(*grid, k);
      if (!off_the_poles(p)) continue;
      const double error = degrees_between(normal(*grid, k), true_normal(p));
      (on_boundary(*grid, k) ? border : inside) += error * error;
      ++(on_boundary(*grid, k) ? outer : inner);
    }
  }
  inside = std::sqrt(inside / inner), border = std::sqrt(border / outer);
  CHECK(inside < 0.5);
  CHECK(border < 1.2 * inside);
}

TEST_CASE("displacement keeps creases", "[dice][displacement]") {
  class Still final : public Displacer {
    void displace(const Grid&, std::span<float>) const override {}
  };
  SubdivisionMesh box = cube_cage();
  for (int face = 0; face < 6; ++face) {
    for (int k = 0; k < 4; ++k) {
      box.creases.push_back(
          {cube_faces[size_t(4 * face + k)], cube_faces[size_t(4 * face + (k + 1) % 4)], 10.0f});
    }
  }
  const Still still;
  const glm::dmat3 object_from_camera = glm::dmat3(glm::inverse(placement()));
  int checked = 0;
  for (const auto& grid : displaced(geometry(box, cube_points()), still)) {
    // Every vertex of a flat face, those on its creases too, has the face's normal.
    const int middle = grid->v_count / 2 * (grid->u_count + 1) + grid->u_count / 2;
    const glm::dvec3 face = glm::round(object_from_camera * normal(*grid, middle));
    for (int k = 0; k < grid->vertex_count(); ++k, ++checked) {
      CHECK(degrees_between(object_from_camera * normal(*grid, k), face) < 0.5);
    }
  }
  CHECK(checked > 1000);
}

// Along the radii of a unit sphere.
double ripples(const glm::dvec3& radius) {
  return 0.02 * std::sin(25 * radius.x) * std::cos(22 * radius.y);
}

class Ripples final : public Displacer {
 public:
  explicit Ripples(const glm::dvec3& about) : about_(about) {}
  void displace(const Grid& grid, std::span<float> distance) const override {
    for (int k = 0; k < grid.vertex_count(); ++k)
      distance[size_t(k)] = float(ripples(glm::normalize(position(grid, k) - about_)));
  }

 private:
  glm::dvec3 about_;
};

// The mean angle on boundaries between a vertex's normal and that of the rippled sphere there.
double mean_error_degrees(double x_at_open, double x_at_close) {
  const glm::dvec3 about(x_at_open, 0, 5);
  const Ripples displacer(about);
  DiceScene s(200, 200);
  s.scene.camera.shutter_close = 1;
  Attributes attributes;
  attributes.displacement.emplace();
  attributes.displacement_bound = 0.2f;
  attributes.motion_factor = 0;
  s.settings.displacer = &displacer;
  Surface& ball = s.add(geometry(Quadric{Quadric::Kind::sphere, {{1, -0.8f, 0.8f, 360}}}),
                        glm::dmat4(1), attributes);
  const auto at = [](double x) { return glm::translate(glm::dmat4(1), glm::dvec3(x, 0, 5)); };
  ball.world_from_object = MovingTransform({0.0f, 1.0f}, {at(x_at_open), at(x_at_close)});
  double sum = 0;
  int count = 0;
  for (const auto& grid : s.all_grids()) {
    for (int k = 0; k < grid->vertex_count(); ++k) {
      if (!on_boundary(*grid, k)) continue;
      const glm::dvec3 d = glm::normalize(position(*grid, k) - about);
      const auto surface = [](const glm::dvec3& near) {
        const glm::dvec3 radius = glm::normalize(near);
        return (1 + ripples(radius)) * radius;
      };
      const glm::dvec3 t = glm::normalize(glm::cross(d, glm::dvec3(0.3, 0.5, 0.8)));
      const glm::dvec3 u = 1e-5 * t, v = 1e-5 * glm::cross(d, t);
      const glm::dvec3 expected = glm::normalize(glm::cross(surface(d + u) - surface(d - u),  //
                                                            surface(d + v) - surface(d - v)));
      const double cosine = std::abs(glm::dot(expected, normal(*grid, k)));
      sum += glm::degrees(std::acos(std::min(1.0, cosine))), ++count;
    }
  }
  CHECK(count > 500);
  return sum / count;
}

TEST_CASE("stencils are as narrow as where the surface is seen, at whatever time",
          "[dice][displaced_normals]") {
  const double still = mean_error_degrees(0, 0);
  CHECK(still < 2);
  CHECK(mean_error_degrees(0, 60) < 1.2 * still + 0.1);
  CHECK(mean_error_degrees(-60, 0) < 1.2 * still + 0.1);
  CHECK(mean_error_degrees(-60, 60) < 1.2 * still + 0.1);
}

}  // namespace
}  // namespace tessera::test
