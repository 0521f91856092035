// Closed surfaces must be diced into closed meshes, bit for bit: every edge of a triangle of any
// grid that is not degenerate is the reverse of an edge of another.

#include <cstring>
#include <random>
#include <set>

#include <catch2/catch.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "tests/dice/dice_scene.h"

namespace tessera::test {
namespace {

using Key = std::array<uint32_t, 3>;

Key bits(const Grid& grid, int key, int vertex) {
  Key k;
  for (int axis = 0; axis < 3; ++axis) {
    // -0 and 0 are one place.
    const float value = grid.P(key, axis)[vertex] + 0.0f;
    std::memcpy(&k[size_t(axis)], &value, 4);
  }
  return k;
}

struct Closure {
  size_t edges = 0, open = 0;
};

Closure closure(const Grids& grids, int key) {
  std::map<std::pair<Key, Key>, int> balance;
  for (const auto& grid : grids) {
    const int width = grid->u_count + 1;
    for (int j = 0; j < grid->v_count; ++j) {
      for (int i = 0; i < grid->u_count; ++i) {
        const int at = j * width + i;
        const Key a = bits(*grid, key, at), b = bits(*grid, key, at + 1);
        const Key c = bits(*grid, key, at + width), d = bits(*grid, key, at + width + 1);
        for (const auto& triangle : {std::array{a, b, d}, std::array{a, d, c}}) {
          for (size_t e = 0; e < 3; ++e) {
            const Key &p = triangle[e], &q = triangle[(e + 1) % 3];
            if (p == q) continue;
            if (p < q) {
              ++balance[{p, q}];
            } else {
              --balance[{q, p}];
            }
          }
        }
      }
    }
  }
  Closure result;
  for (const auto& entry : balance) {
    ++result.edges;
    result.open += entry.second != 0;
  }
  return result;
}

void require_closed(DiceScene& s) {
  const Grids grids = s.all_grids();
  REQUIRE(!grids.empty());
  INFO("grids " << grids.size());
  for (int key = 0; key < grids[0]->key_count(); ++key) {
    const Closure c = closure(grids, key);
    INFO("key " << key << " edges " << c.edges);
    CHECK(c.edges > 12);
    CHECK(c.open == 0);
  }
  CHECK(s.diagnostics.lines().empty());
}

// Placements from tiny to filling the frame, turned any way; all in front of the camera.
glm::dmat4 placement(int variant) {
  std::mt19937 random{uint32_t(variant) * 7919u + 1u};
  std::uniform_real_distribution<double> uniform(-1, 1);
  const double distance[4] = {5, 9, 25, 3.6};
  glm::dmat4 m = glm::translate(
      glm::dmat4(1),
      glm::dvec3(0.2 * uniform(random), 0.2 * uniform(random), distance[variant % 4]));
  m = glm::rotate(m, 3.0 * uniform(random), glm::dvec3(uniform(random), uniform(random), 1.1));
  return m;
}

constexpr int variants = 4;
constexpr float rates[variants] = {1.0f, 0.6f, 5.0f, 2.3f};

// Moves and turns every surface, opens the lens, and lets micropolygons grow with both kinds of
// blur: with one sharp end or none.
void blur(DiceScene& s, int variant) {
  const glm::dmat4 there =
      glm::rotate(glm::translate(glm::dmat4(1), glm::dvec3(0.6, 0.1 * variant, 0.4)), 0.05,
                  glm::dvec3(0, 1, 1));
  for (Surface& surface : s.scene.surfaces) {
    const glm::dmat4 here = surface.world_from_object.at(0);
    const glm::dmat4 between = glm::translate(glm::dmat4(1), glm::dvec3(0.2, 0, 0.1)) * here;
    surface.world_from_object = MovingTransform({0.0f, 0.4f, 1.0f}, {here, between, there * here});
    auto attributes = std::make_shared<Attributes>(*surface.attributes);
    attributes->motion_factor = variant % 2 ? 3.0f : 50.0f;
    attributes->focus_factor = variant < 2 ? 2.0f : 100.0f;
    surface.attributes = std::move(attributes);
  }
  s.scene.camera.shutter_open = 0;
  s.scene.camera.shutter_close = 1;
  s.scene.camera.lens = CameraSettings::ThinLens{1.4, 0.7, variant % 2 ? 8.5 : 20.0};
}

uint64_t micropolygon_count(DiceScene& s) {
  DiceCounters counters;
  s.all_grids(&counters);
  return counters.micropolygons;
}

void require_closed_everywhere(const Geometry& g) {
  for (int variant = 0; variant < variants; ++variant) {
    INFO("variant " << variant);
    DiceScene s(200, 200);
    Attributes attributes;
    attributes.shading_rate = rates[variant];
    s.add(g, placement(variant), attributes);
    s.settings.max_grid_size = variant == 1 ? 7 : 32;
    require_closed(s);
    blur(s, variant);
    require_closed(s);
  }
}

TEST_CASE("the blurred surfaces of these tests are diced coarser", "[dice][watertight]") {
  uint64_t coarse = 0, full = 0;
  for (int variant = 0; variant < variants; ++variant) {
    DiceScene s(200, 200);
    s.add(geometry(torus_cage(7, 5), torus_points(7, 5)), placement(variant));
    blur(s, variant);
    coarse += micropolygon_count(s);
    for (Surface& surface : s.scene.surfaces) {
      auto attributes = std::make_shared<Attributes>(*surface.attributes);
      attributes->motion_factor = attributes->focus_factor = 0.0f;
      surface.attributes = std::move(attributes);
    }
    full += micropolygon_count(s);
  }
  CHECK(double(coarse) < 0.7 * double(full));
}

TEST_CASE("subdivision cube is watertight", "[dice][watertight]") {
  SubdivisionMesh mesh = cube_cage();
  require_closed_everywhere(geometry(mesh, cube_points()));
  mesh.creases = {{0, 1, 2.5f}, {1, 3, 10.0f}, {3, 2, 1.0f}};
  mesh.corners = {{7, 10.0f}, {6, 1.5f}};
  require_closed_everywhere(geometry(mesh, cube_points()));
}

TEST_CASE("regular subdivision torus is watertight", "[dice][watertight]") {
  require_closed_everywhere(geometry(torus_cage(7, 5), torus_points(7, 5)));
}

TEST_CASE("many small faces are watertight", "[dice][watertight]") {
  require_closed_everywhere(geometry(torus_cage(40, 30), torus_points(40, 30)));
}

TEST_CASE("mixed faces are watertight", "[dice][watertight]") {
  // A pentagonal prism with one roof cut into triangles around a raised middle.
  SubdivisionMesh mesh;
  std::vector<glm::vec3> points;
  for (int k = 0; k < 5; ++k) {
    const float a = 6.2831853f * float(k) / 5.0f;
    points.emplace_back(std::cos(a), std::sin(a), -0.7f);
  }
  for (int k = 0; k < 5; ++k) points.push_back(points[size_t(k)] + glm::vec3(0.1f, 0, 1.4f));
  points.emplace_back(0, 0, 1.3f);
  mesh.face_vertex_counts = {5};
  mesh.face_vertices = {4, 3, 2, 1, 0};
  for (int k = 0; k < 5; ++k) {
    const int n = (k + 1) % 5;
    mesh.face_vertex_counts.push_back(4);
    mesh.face_vertices.insert(mesh.face_vertices.end(), {k, n, n + 5, k + 5});
    mesh.face_vertex_counts.push_back(3);
    mesh.face_vertices.insert(mesh.face_vertices.end(), {k + 5, n + 5, 10});
  }
  require_closed_everywhere(geometry(mesh, points));
}

TEST_CASE("loop tetrahedron is watertight", "[dice][watertight]") {
  SubdivisionMesh mesh;
  mesh.scheme = SubdivisionMesh::Scheme::loop;
  mesh.face_vertex_counts.assign(4, 3);
  mesh.face_vertices = {0, 1, 2, 0, 3, 1, 1, 3, 2, 2, 3, 0};
  require_closed_everywhere(geometry(mesh, {{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}}));
}

TEST_CASE("periodic patch mesh torus is watertight", "[dice][watertight]") {
  PatchMesh mesh = bicubic_mesh(9, 6);
  mesh.u_periodic = mesh.v_periodic = true;
  mesh.u_basis = mesh.v_basis = bspline_basis();
  mesh.u_step = mesh.v_step = 1;
  require_closed_everywhere(geometry(mesh, torus_points(9, 6)));
  PatchMesh bilinear;
  bilinear.u_vertices = 9, bilinear.v_vertices = 6;
  bilinear.u_periodic = bilinear.v_periodic = true;
  require_closed_everywhere(geometry(bilinear, torus_points(9, 6)));
}

TEST_CASE("full quadrics are watertight", "[dice][watertight]") {
  Quadric sphere{Quadric::Kind::sphere, {{1.0, -1.0, 1.0, 360.0}}};
  require_closed_everywhere(geometry(sphere));
  Quadric torus{Quadric::Kind::torus, {{1.0, 0.4, 0.0, 360.0, 360.0}}};
  require_closed_everywhere(geometry(torus));
}

TEST_CASE("a sphere in octants of separate patches is watertight", "[dice][watertight]") {
  // Six bicubic faces of a puffed cube, each a surface of its own with its own parameter
  // directions; only their boundary control points are the same.
  for (int variant = 0; variant < variants; ++variant) {
    DiceScene s(200, 200);
    Attributes attributes;
    attributes.shading_rate = rates[variant];
    const std::vector<glm::vec3> cube = cube_points();
    for (int face = 0; face < 6; ++face) {
      const int* c = cube_faces.data() + 4 * face;
      std::vector<glm::vec3> points;
      // Turn the parameters by a number of quarter turns that differs from face to face.
      const int turn = (face + variant) % 4;
      const auto corner = [&](int k) { return cube[size_t(c[(k + turn) % 4])]; };
      for (int j = 0; j < 4; ++j) {
        for (int i = 0; i < 4; ++i) {
          // A function of the point alone that is symmetric in rounding: thirds of the cube's
          // edges, pushed out by a quantised bulge.
          const auto weight = [](int k) { return float(std::round(k * 1024.0 / 3.0) / 1024.0); };
          const glm::vec3 low = corner(0) * (1 - weight(i)) + corner(1) * weight(i);
          const glm::vec3 high = corner(3) * (1 - weight(i)) + corner(2) * weight(i);
          glm::vec3 p = low * (1 - weight(j)) + high * weight(j);
          p = glm::round(p * 64.0f) / 64.0f;
          p = glm::round(p * (2.0f - 0.3f * glm::dot(p, p)) * 256.0f) / 256.0f;
          points.push_back(p);
        }
      }
      s.add(geometry(bicubic_mesh(), points), placement(variant), attributes);
    }
    require_closed(s);
    blur(s, variant);
    require_closed(s);
  }
}

PolygonMesh icosahedron(std::vector<glm::vec3>& points) {
  const float g = 1.6180340f;
  points = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
            {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  PolygonMesh mesh;
  mesh.vertices = {0, 11, 5,  0, 5,  1, 0, 1, 7, 0, 7,  10, 0, 10, 11, 1, 5, 9, 5, 11,
                   4, 11, 10, 2, 10, 7, 6, 7, 1, 8, 3,  9,  4, 3,  4,  2, 3, 2, 6, 3,
                   6, 8,  3,  8, 9,  4, 9, 5, 2, 4, 11, 6,  2, 10, 8,  6, 7, 9, 8, 1};
  mesh.loops_per_polygon.assign(20, 1);
  mesh.vertices_per_loop.assign(20, 3);
  return mesh;
}

TEST_CASE("polygon meshes are watertight", "[dice][watertight]") {
  std::vector<glm::vec3> points;
  const PolygonMesh mesh = icosahedron(points);
  require_closed_everywhere(geometry(mesh, points));
  // A cube with a square hole through two faces: quadrangles, and two polygons with holes.
  std::vector<glm::vec3> tube = cube_points();
  for (const glm::vec3& p : cube_points()) tube.emplace_back(p.x * 0.4f, p.y * 0.3f, p.z);
  PolygonMesh pierced;
  pierced.loops_per_polygon = {2, 2, 1, 1, 1, 1, 1, 1, 1, 1};
  pierced.vertices_per_loop = {4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4};
  pierced.vertices = {0, 2,  3,  1, 8,  9,  11, 10, 4, 5,  7,  6,  12, 14, 15, 13,
                      0, 1,  5,  4, 2,  6,  7,  3,  0, 4,  6,  2,  1,  3,  7,  5,
                      8, 12, 13, 9, 10, 11, 15, 14, 8, 10, 14, 12, 9,  13, 15, 11};
  require_closed_everywhere(geometry(pierced, tube));
}

TEST_CASE("a moving deforming surface is watertight at every key", "[dice][watertight]") {
  DiceScene s(200, 200);
  Geometry g = geometry(cube_cage(), cube_points());
  g.key_times = {0.0f, 0.3f, 1.0f};
  for (int k = 1; k < 3; ++k) {
    std::vector<glm::vec3> p = cube_points();
    for (glm::vec3& v : p)
      v = v * (1.0f + 0.2f * float(k)) + glm::vec3(0.1f * v.y, 0.3f * float(k), 0);
    g.P_object.push_back(p);
  }
  Surface& surface = s.add(g);
  surface.world_from_object = MovingTransform({0.0f, 0.5f}, {placement(0), placement(4)});
  const Grids grids = s.all_grids();
  CHECK(grids.at(0)->key_times == std::vector<float>{0.0f, 0.3f, 0.5f, 1.0f});
  require_closed(s);
}

// Bumps that depend on everything a displacement shader may read.
class Bumps final : public Displacer {
 public:
  void displace(const Grid& grid, std::span<float> distance) const override {
    for (int k = 0; k < grid.vertex_count(); ++k) {
      const float x = grid.P(0, 0)[k], y = grid.P(0, 1)[k], n = grid.N(0)[k];
      const float s = grid.st[size_t(k)], t = grid.st[grid.stride() + size_t(k)];
      distance[size_t(k)] = 0.1f * std::sin(9.0f * x + 7.0f * y) + 0.03f * n +
                            0.02f * std::sin(11.0f * s) * std::cos(5.0f * t);
    }
  }
};

TEST_CASE("displaced closed surfaces are watertight", "[dice][watertight][displacement]") {
  std::vector<glm::vec3> ico;
  const PolygonMesh ico_mesh = icosahedron(ico);
  SubdivisionMesh creased = cube_cage();
  creased.creases = {{0, 1, 10.0f}, {1, 3, 10.0f}, {3, 2, 1.0f}};
  PatchMesh patches = bicubic_mesh(9, 6);
  patches.u_periodic = patches.v_periodic = true;
  patches.u_basis = patches.v_basis = bspline_basis();
  patches.u_step = patches.v_step = 1;
  const Quadric sphere{Quadric::Kind::sphere, {{1.0, -1.0, 1.0, 360.0}}};
  const std::vector<Geometry> shapes{
      geometry(creased, cube_points()), geometry(torus_cage(7, 5), torus_points(7, 5)),
      geometry(patches, torus_points(9, 6)), geometry(sphere), geometry(ico_mesh, ico)};
  const Bumps bumps;
  for (size_t shape = 0; shape < shapes.size(); ++shape) {
    for (int variant = 0; variant < variants; ++variant) {
      INFO("shape " << shape << " variant " << variant);
      DiceScene s(200, 200);
      Attributes attributes;
      attributes.displacement.emplace();
      attributes.displacement_bound = 0.2f;
      attributes.shading_rate = rates[variant];
      s.settings.displacer = &bumps;
      s.add(shapes[shape], placement(variant), attributes);
      require_closed(s);
      blur(s, variant);
      require_closed(s);
    }
  }
}

TEST_CASE("what passes the frame between keys is watertight", "[dice][watertight]") {
  for (const double x : {8.0, 100.0, 5000.0}) {
    INFO("from -" << x << " to " << x);
    DiceScene s;
    s.scene.camera.shutter_close = 1;
    Surface& torus = s.add(geometry(torus_cage(7, 5), torus_points(7, 5)));
    const auto at = [](double to_side, double angle) {
      return glm::rotate(glm::translate(glm::dmat4(1), glm::dvec3(to_side, 0, 5)), angle,
                         glm::dvec3(1, 1, 0));
    };
    torus.world_from_object = MovingTransform({0.0f, 1.0f}, {at(-x, 0.6), at(x, 0.9)});
    require_closed(s);
  }
}

}  // namespace
}  // namespace tessera::test
