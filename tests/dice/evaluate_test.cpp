// Patches against closed forms and OpenSubdiv's own evaluation.

#include <cmath>

#include <catch2/catch.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "dice/surface_context.h"
#include "dice/subdivision_topology.h"
#include "tests/dice/dice_scene.h"

namespace tessera::test {
namespace {

glm::vec3 P_of(const Grid& g, int k, int key = 0) {
  return {g.P(key, 0)[k], g.P(key, 1)[k], g.P(key, 2)[k]};
}
glm::vec3 N_of(const Grid& g, int k) { return {g.N(0)[k], g.N(1)[k], g.N(2)[k]}; }

const glm::dmat4 away = glm::translate(glm::dmat4(1), glm::dvec3(0, 0, 6));

/// Calls check(P, N, u, v) for every vertex, P in object space (the transform is `away`).
template <class Check>
void for_all_vertices(DiceScene& s, const Check& check) {
  const Grids grids = s.all_grids();
  REQUIRE(!grids.empty());
  for (const auto& g : grids) {
    for (int k = 0; k < g->vertex_count(); ++k) {
      check(P_of(*g, k) - glm::vec3(0, 0, 6), N_of(*g, k), g->uv[size_t(k)],
            g->uv[g->stride() + size_t(k)]);
    }
  }
}

TEST_CASE("a bicubic patch reproduces a bicubic polynomial", "[dice][evaluate]") {
  // z = x^3 - 2 x y^2 + y^3 / 2 over [0,1]^2 by polar forms: for the monomial x^a the Bezier
  // points of degree 3 are binomial(i, a) / binomial(3, a).
  const auto polar = [](int i, int a) {
    double value = 1;
    for (int k = 0; k < a; ++k) value *= double(i - k) / double(3 - k);
    return value;
  };
  std::vector<glm::vec3> points;
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) {
      const double z = polar(i, 3) - 2 * polar(i, 1) * polar(j, 2) + 0.5 * polar(j, 3);
      points.emplace_back(i / 3.0, j / 3.0, z);
    }
  }
  DiceScene s;
  s.add(geometry(bicubic_mesh(), points), away);
  for_all_vertices(s, [](glm::vec3 P, glm::vec3 N, double u, double v) {
    CHECK(P.x == Approx(u).margin(2e-6));
    CHECK(P.y == Approx(v).margin(2e-6));
    CHECK(P.z == Approx(u * u * u - 2 * u * v * v + 0.5 * v * v * v).margin(4e-6));
    const glm::dvec3 expected =
        glm::normalize(glm::dvec3(-(3 * u * u - 2 * v * v), -(-4 * u * v + 1.5 * v * v), 1));
    CHECK(glm::dot(glm::dvec3(N), expected) > 1 - 1e-6);
  });
}

TEST_CASE("quadrics lie on their surfaces with outward normals", "[dice][evaluate]") {
  struct Case {
    Quadric quadric;
    // Zero on the surface; its gradient is the normal, up to sign and length.
    double (*f)(glm::dvec3);
  };
  const Case cases[] = {
      {{Quadric::Kind::sphere, {{1.2, -0.7, 1.0, 250}}},
       [](glm::dvec3 p) { return glm::dot(p, p) - 1.44; }},
      {{Quadric::Kind::sphere, {{1.0, -1.0, 1.0, 360}}},
       [](glm::dvec3 p) { return glm::dot(p, p) - 1; }},
      {{Quadric::Kind::cone, {{2.0, 0.9, 360}}},
       [](glm::dvec3 p) { return std::hypot(p.x, p.y) - 0.9 * (1 - p.z / 2); }},
      {{Quadric::Kind::cylinder, {{0.8, -0.5, 1, -200}}},
       [](glm::dvec3 p) { return std::hypot(p.x, p.y) - 0.8; }},
      {{Quadric::Kind::hyperboloid, {{1, 0, -1, 0.6, 0.8, 1, 360}}},
       // The line (1 - 0.2 s, 0.4 s), z = s - 1: radius squared (1 - 0.2 s)^2 + 0.16 s^2.
       [](glm::dvec3 p) {
         const double h = p.z + 1;
         return p.x * p.x + p.y * p.y - ((1 - 0.2 * h) * (1 - 0.2 * h) + 0.16 * h * h);
       }},
      {{Quadric::Kind::paraboloid, {{1.0, 0.0, 1.5, 360}}},
       [](glm::dvec3 p) { return p.x * p.x + p.y * p.y - p.z / 1.5; }},
      {{Quadric::Kind::disk, {{0.3, 1.0, 300}}}, [](glm::dvec3 p) { return p.z - 0.3; }},
      {{Quadric::Kind::torus, {{1.0, 0.3, 20, 200, 360}}}, [](glm::dvec3 p) {
         const double r = std::hypot(p.x, p.y) - 1;
         return r * r + p.z * p.z - 0.09;
       }}};
  for (const Case& c : cases) {
    INFO("kind " << int(c.quadric.kind));
    DiceScene s;
    s.add(geometry(c.quadric), away);
    double worst = 0, worst_angle = 1;
    for_all_vertices(s, [&](glm::vec3 P, glm::vec3 N, double, double v) {
      worst = std::max(worst, std::abs(c.f(P)));
      CHECK(glm::length(N) == Approx(1).margin(1e-5));
      // Poles and apexes have no gradient.
      if (v < 0.01 || v > 0.99) return;
      glm::dvec3 gradient;
      for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 e(0);
        e[axis] = 1e-5;
        gradient[axis] = c.f(glm::dvec3(P) + e) - c.f(glm::dvec3(P) - e);
      }
      worst_angle =
          std::min(worst_angle, std::abs(glm::dot(glm::normalize(gradient), glm::dvec3(N))));
    });
    CHECK(worst < 5e-6);
    CHECK(worst_angle > 1 - 1e-5);
  }
}

TEST_CASE("a sphere's normals point outwards, and turn with Orientation and mirrors",
          "[dice][evaluate]") {
  for (const bool flip : {false, true}) {
    for (const bool mirrored_camera : {false, true}) {
      DiceScene s;
      Surface& surface = s.add(geometry(Quadric{Quadric::Kind::sphere, {{1, -1, 1, 360}}}), away);
      surface.flip_normal = flip;
      if (mirrored_camera) {
        s.scene.camera.camera_from_world =
            MovingTransform(glm::scale(glm::dmat4(1), glm::dvec3(-1, 1, 1)));
      }
      for (const auto& g : s.all_grids()) {
        for (int k = 0; k < g->vertex_count(); ++k) {
          const glm::vec3 out = P_of(*g, k) - glm::vec3(0, 0, 6);
          CHECK(glm::dot(N_of(*g, k), out) * (flip ? -1 : 1) > 0.99f);
        }
        // normal_sign says the same of the micropolygon in the middle.
        const int a = g->v_count / 2 * (g->u_count + 1) + g->u_count / 2;
        const glm::vec3 A = P_of(*g, a), B = P_of(*g, a + 1), D = P_of(*g, a + g->u_count + 2);
        CHECK(glm::dot(glm::cross(B - A, D - A) * g->normal_sign, N_of(*g, a)) > 0);
      }
    }
  }
}

TEST_CASE("a rational NuPatch makes an exact cylinder", "[dice][evaluate]") {
  // The nine-point circle: quadratic, weights 1 and sqrt(1/2), double inner knots.
  NurbsPatch nurbs;
  nurbs.u_vertices = 9, nurbs.u_order = 3, nurbs.v_vertices = 2, nurbs.v_order = 2;
  nurbs.u_knots = {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4};
  nurbs.v_knots = {0, 0, 1, 1};
  nurbs.u_max = 4, nurbs.v_max = 1;
  const float x[9] = {1, 1, 0, -1, -1, -1, 0, 1, 1}, y[9] = {0, 1, 1, 1, 0, -1, -1, -1, 0};
  std::vector<glm::vec3> points;
  std::vector<float> weights;
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < 9; ++i) {
      points.emplace_back(x[i], y[i], float(j));
      weights.push_back(i % 2 ? float(std::sqrt(0.5)) : 1.0f);
    }
  }
  nurbs.weights = {weights};
  DiceScene s;
  s.add(geometry(nurbs, points), away);
  for_all_vertices(s, [](glm::vec3 P, glm::vec3 N, double u, double v) {
    CHECK(std::hypot(P.x, P.y) == Approx(1).margin(3e-6));
    CHECK(P.z == Approx(v).margin(2e-6));
    CHECK(std::abs(P.x * N.x + P.y * N.y) > 0.99999f);
    // The middle of each quarter is at its parameter's middle.
    if (u == 0.125) CHECK(P.x == Approx(P.y).margin(1e-5));
  });
}

TEST_CASE("a polynomial NuPatch agrees with the B-spline it is", "[dice][evaluate]") {
  // A PatchMesh in the uniform B-spline basis is the same surface.
  std::vector<glm::vec3> points;
  for (int j = 0; j < 6; ++j) {
    for (int i = 0; i < 5; ++i) {
      points.emplace_back(0.4f * float(i), 0.4f * float(j), 0.3f * std::sin(float(3 * i + 2 * j)));
    }
  }
  NurbsPatch nurbs;
  nurbs.u_vertices = 5, nurbs.v_vertices = 6, nurbs.u_order = nurbs.v_order = 4;
  for (int k = 0; k < 9; ++k) nurbs.u_knots.push_back(k);
  for (int k = 0; k < 10; ++k) nurbs.v_knots.push_back(k);
  nurbs.u_min = 3, nurbs.u_max = 5, nurbs.v_min = 3, nurbs.v_max = 6;
  PatchMesh mesh = bicubic_mesh(5, 6);
  mesh.u_basis = mesh.v_basis = bspline_basis();
  mesh.u_step = mesh.v_step = 1;
  DiceScene a, b;
  a.add(geometry(nurbs, points), away);
  b.add(geometry(mesh, points), away);
  const Grids left = a.all_grids(), right = b.all_grids();
  REQUIRE(left.size() == right.size());
  for (size_t g = 0; g < left.size(); ++g) {
    REQUIRE(left[g]->vertex_count() == right[g]->vertex_count());
    for (int k = 0; k < left[g]->vertex_count(); ++k) {
      CHECK(glm::distance(P_of(*left[g], k), P_of(*right[g], k)) < 3e-6f);
      CHECK(left[g]->uv[size_t(k)] == Approx(right[g]->uv[size_t(k)]).margin(1e-6));
    }
  }
}

// Every vertex of a subdivision surface against Bfr at the same parameters.
void compare_with_bfr(const SubdivisionMesh& mesh, const std::vector<glm::vec3>& points) {
  DiceScene s;
  const Surface& surface = s.add(geometry(mesh, points), away);
  const SubdivisionTopology topology(*surface.geometry);
  float worst = 0, worst_normal = 1;
  const Grids grids = s.all_grids();
  REQUIRE(!grids.empty());
  for (const auto& g : grids) {
    SubdivisionTopology::BfrSurface face;
    REQUIRE(topology.factory().InitVertexSurface(topology.face_of(g->id.face), &face));
    std::vector<float> patch(size_t(face.GetNumPatchPoints()) * 3);
    face.PreparePatchPoints(&points[0].x, 3, patch.data(), 3);
    for (int k = 0; k < g->vertex_count(); ++k) {
      float uv[2];
      topology.face_parameters(g->id.face, g->uv[size_t(k)], g->uv[g->stride() + size_t(k)], uv);
      glm::vec3 P, Du, Dv;
      face.Evaluate(uv, patch.data(), 3, &P.x, &Du.x, &Dv.x);
      worst = std::max(worst, glm::distance(P, P_of(*g, k) - glm::vec3(0, 0, 6)));
      const glm::vec3 N = glm::cross(Du, Dv);
      if (glm::length(N) > 1e-4f) {
        worst_normal = std::min(worst_normal, glm::dot(glm::normalize(N), N_of(*g, k)));
      }
    }
  }
  CHECK(worst < 4e-6f);
  CHECK(worst_normal > 1 - 1e-5f);
}

TEST_CASE("subdivision surfaces agree with Bfr", "[dice][evaluate]") {
  compare_with_bfr(torus_cage(7, 5), torus_points(7, 5));
  SubdivisionMesh cube = cube_cage();
  compare_with_bfr(cube, cube_points());
  cube.creases = {{0, 1, 2.0f}, {1, 3, 10.0f}};
  compare_with_bfr(cube, cube_points());
  // An open sheet: boundaries and corners of regular faces.
  SubdivisionMesh sheet;
  std::vector<glm::vec3> points;
  for (int j = 0; j < 5; ++j) {
    for (int i = 0; i < 5; ++i) {
      points.emplace_back(0.5f * float(i) - 1, 0.5f * float(j) - 1, 0.3f * std::sin(float(i * j)));
      if (i == 4 || j == 4) continue;
      const int a = j * 5 + i;
      sheet.face_vertex_counts.push_back(4);
      sheet.face_vertices.insert(sheet.face_vertices.end(), {a, a + 1, a + 6, a + 5});
    }
  }
  sheet.holes = {5};
  for (const auto boundary :
       {SubdivisionMesh::Boundary::edge_and_corner, SubdivisionMesh::Boundary::edge_only,
        SubdivisionMesh::Boundary::none}) {
    sheet.boundary = boundary;
    compare_with_bfr(sheet, points);
  }
}

TEST_CASE("cube cage limit points follow Catmull and Clark's masks", "[dice][evaluate]") {
  // At a vertex of valence n the limit is (n^2 v + 4 sum e + sum f) / (n (n + 5)), e the other
  // ends of edges, f the opposite corners of faces (Halstead, Kass, DeRose 1993). For the cube
  // around (1,1,1): v = 1, sum e = 1 + 1 - 1, sum f = 1 - 1 - 1 a coordinate, n = 3.
  const float expected = (9.0f + 4.0f * 1.0f + (-1.0f)) / 24.0f;
  DiceScene s;
  s.add(geometry(cube_cage(), cube_points()), away);
  int corners = 0;
  for_all_vertices(s, [&](glm::vec3 P, glm::vec3, double u, double v) {
    if ((u != 0 && u != 1) || (v != 0 && v != 1)) return;
    ++corners;
    for (int axis = 0; axis < 3; ++axis) CHECK(std::abs(P[axis]) == Approx(expected).margin(1e-5));
  });
  CHECK(corners >= 24);
}

TEST_CASE("collapsed patches have unit normals everywhere", "[dice][evaluate]") {
  // Side 2 is one point, and so is, in the second case, the whole of the patch's row below.
  for (int collapsed_rows = 1; collapsed_rows <= 2; ++collapsed_rows) {
    std::vector<glm::vec3> points;
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 4; ++i) {
        const bool is_tip = j >= 4 - collapsed_rows;
        points.push_back(is_tip ? glm::vec3(0.5f, 1, 0)
                                : glm::vec3(i / 3.0f, j / 3.0f, 0.2f * float(i * (3 - i))));
      }
    }
    DiceScene s;
    s.add(geometry(bicubic_mesh(), points), away);
    for_all_vertices(s, [](glm::vec3, glm::vec3 N, double, double) {
      CHECK(glm::length(N) == Approx(1).margin(1e-4));
      CHECK(N.z > 0);
    });
  }
}

TEST_CASE("primitive variables interpolate by their class", "[dice][primvar]") {
  DiceScene s;
  std::vector<glm::vec3> points;
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 7; ++i) points.emplace_back(i / 3.0f, j / 3.0f, 0);
  }
  Geometry g = geometry(bicubic_mesh(7, 4), points);
  const auto add = [&](const char* name, StorageClass storage, ValueType type,
                       std::vector<float> numbers) {
    Parameter p;
    p.name = name, p.storage = storage, p.type = type, p.numbers = std::move(numbers);
    g.primvars.push_back(p);
  };
  std::vector<float> vertex;
  for (const glm::vec3& p : points) vertex.push_back(2 * p.x - p.y);
  add("vertex", StorageClass::vertex, ValueType::scalar, vertex);
  add("varying", StorageClass::varying, ValueType::scalar, {0, 1, 2, 10, 11, 12});
  add("uniform", StorageClass::uniform, ValueType::color, {1, 2, 3, 4, 5, 6});
  add("constant", StorageClass::constant, ValueType::scalar, {7});
  add("unwanted", StorageClass::constant, ValueType::scalar, {7});
  add("st", StorageClass::varying, ValueType::scalar, {0, 5, 1, 5, 2, 5, 0, 6, 1, 6, 2, 6});
  g.primvars.back().array_size = 2;
  s.settings.wants_primvar = [](const Attributes&, std::string_view n) { return n != "unwanted"; };
  s.add(g, away);
  for (const auto& grid : s.all_grids()) {
    REQUIRE(grid->primvars.size() == 4);
    for (int k = 0; k < grid->vertex_count(); ++k) {
      const glm::vec3 P = P_of(*grid, k);
      const auto value = [&](size_t p, int c = 0) {
        return grid->primvars[p].component(c, grid->stride())[k];
      };
      CHECK(value(0) == Approx(2 * P.x - P.y).margin(1e-5));
      CHECK(value(1) == Approx(P.x + 10 * P.y).margin(1e-5));
      CHECK(value(2, 1) == (grid->id.face == 0 ? 2.0f : 5.0f));
      CHECK(value(3) == 7.0f);
      CHECK(grid->st[size_t(k)] == Approx(P.x).margin(1e-5));
      CHECK(grid->st[grid->stride() + size_t(k)] == Approx(5 + P.y).margin(1e-5));
      CHECK(grid->uv[size_t(k)] == Approx(P.x / 2).margin(1e-5));
    }
  }
}

TEST_CASE("face-varying texture coordinates of a subdivision mesh keep their seams",
          "[dice][primvar]") {
  DiceScene s;
  SubdivisionMesh mesh = cube_cage();
  mesh.facevarying_boundary = 3;
  Geometry g = geometry(mesh, cube_points());
  Parameter st;
  st.name = "st", st.storage = StorageClass::facevarying, st.array_size = 2;
  // Each face has a tile of its own, four apart.
  for (int f = 0; f < 6; ++f) {
    const float s0 = 4.0f * float(f);
    for (float x : {s0, 0.0f, s0 + 1, 0.0f, s0 + 1, 1.0f, s0, 1.0f}) st.numbers.push_back(x);
  }
  g.primvars.push_back(st);
  s.add(g, away);
  for (const auto& grid : s.all_grids()) {
    for (int k = 0; k < grid->vertex_count(); ++k) {
      const float u = grid->uv[size_t(k)], v = grid->uv[grid->stride() + size_t(k)];
      CHECK(grid->st[size_t(k)] == Approx(4.0f * float(grid->id.face) + u).margin(1e-4));
      CHECK(grid->st[grid->stride() + size_t(k)] == Approx(v).margin(1e-4));
    }
  }
}

}  // namespace
}  // namespace tessera::test
