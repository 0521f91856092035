/// Shape requests: what they become, and what is refused.

#include "rib_test_utils.h"

using namespace tessera;
using namespace tessera::test;

namespace {

ReadResult last_read;

/// The geometry of the only shape in `text`.
const Geometry& geometry_of(const std::string& text) {
  last_read = read_world(text);
  REQUIRE(last_read.scene().surfaces.size() == 1);
  return *last_read.scene().surfaces[0].geometry;
}

template <class T>
const T& shape_of(const std::string& text) {
  return std::get<T>(geometry_of(text).shape);
}

const std::string cube_faces =
    "[4 4 4 4 4 4] [0 1 3 2  4 6 7 5  0 4 5 1  2 3 7 6  0 2 6 4  1 5 7 3]";
const std::string cube_points = " \"P\" [0 0 0 1 0 0 0 1 0 1 1 0 0 0 1 1 0 1 0 1 1 1 1 1] ";

std::string points(int count) {
  std::string text = " \"P\" [";
  for (int i = 0; i < count; ++i) text += fmt::format("{} {} 0 ", i % 4, i / 4);
  return text + "] ";
}

}  // namespace

TEST_CASE("subdivision meshes with and without tags") {
  const auto& plain =
      shape_of<SubdivisionMesh>("SubdivisionMesh \"catmull-clark\" " + cube_faces + cube_points);
  CHECK(plain.face_vertex_counts.size() == 6);
  CHECK(plain.boundary == SubdivisionMesh::Boundary::none);
  const auto& tagged = shape_of<SubdivisionMesh>(
      "SubdivisionMesh \"catmull-clark\" " + cube_faces +
      "[\"crease\" \"crease\" \"corner\" \"hole\" \"interpolateboundary\" "
      "\"facevaryinginterpolateboundary\" \"facevaryingpropagatecorners\" \"odd\"]"
      "[3 1 3 2 2 1 1 0 1 0 1 0 1 0 0 1] [0 1 3  0 2 6  4 5  3  2  1  0] [2.5  1 2  9  7]" +
      cube_points);
  REQUIRE(tagged.creases.size() == 4);
  CHECK(tagged.creases[1].v0 == 1);
  CHECK(tagged.creases[1].v1 == 3);
  CHECK(tagged.creases[1].sharpness == 2.5f);
  CHECK(tagged.creases[3].sharpness == 2.0f);
  REQUIRE(tagged.corners.size() == 2);
  CHECK(tagged.corners[1].vertex == 5);
  CHECK(tagged.corners[1].sharpness == 9);
  CHECK(tagged.holes == std::vector<int>{3});
  CHECK(tagged.boundary == SubdivisionMesh::Boundary::edge_only);
  CHECK(tagged.facevarying_boundary == 1);
  REQUIRE(last_read.warnings.size() == 1);
  CHECK_THAT(last_read.warnings[0], Contains("\"odd\""));
  const auto& bare_tag =
      shape_of<SubdivisionMesh>("SubdivisionMesh \"catmull-clark\" " + cube_faces +
                                "\"interpolateboundary\" [0 0] [] []" + cube_points);
  CHECK(bare_tag.boundary == SubdivisionMesh::Boundary::edge_and_corner);
  const auto& empty_tags = shape_of<SubdivisionMesh>(
      "SubdivisionMesh \"loop\" 3 [0 1 2] [] [] [] "
      "[] \"P\" [0 0 0 1 0 0 0 1 0]");
  CHECK(empty_tags.scheme == SubdivisionMesh::Scheme::loop);
  shape_of<SubdivisionMesh>("SubdivisionMesh \"catmull-clark\" " + cube_faces +
                            "[\"crease\"] [2 1] [0 7] [1]" + cube_points);
  CHECK_THAT(last_read.warnings.at(0), Contains("no edge joins vertices 0 and 7"));
}

TEST_CASE("polygons in four forms") {
  const auto& polygon = shape_of<PolygonMesh>("Polygon" + points(5));
  CHECK(polygon.vertices == std::vector<int>{0, 1, 2, 3, 4});
  CHECK(polygon.vertices_per_loop == std::vector<int>{5});
  const auto& general = shape_of<PolygonMesh>("GeneralPolygon [4 3]" + points(7));
  CHECK(general.loops_per_polygon == std::vector<int>{2});
  CHECK(general.vertices_per_loop == std::vector<int>{4, 3});
  const auto& mesh = shape_of<PolygonMesh>("PointsPolygons [3 4] [0 1 2 0 1 2 3]" + points(4));
  CHECK(mesh.loops_per_polygon == std::vector<int>{1, 1});
  const auto& holes = shape_of<PolygonMesh>(
      "PointsGeneralPolygons [2 1] [4 3 3] [0 1 2 3 4 5 6 0 1 2]" + points(7));
  CHECK(holes.loops_per_polygon == std::vector<int>{2, 1});
  CHECK(holes.vertices.size() == 10);
}

TEST_CASE("patches take the basis in force") {
  CHECK_FALSE(shape_of<PatchMesh>("Patch \"bilinear\"" + points(4)).bicubic);
  const auto& bezier = shape_of<PatchMesh>("Patch \"bicubic\"" + points(16));
  CHECK(bezier.u_basis[1] == 3);
  CHECK(bezier.u_step == 3);
  const auto& spline = shape_of<PatchMesh>(
      "Basis \"b-spline\" 1 \"catmull-rom\" 1 PatchMesh \"bicubic\" 6 \"nonperiodic\" 5 "
      "\"periodic\"" +
      points(30));
  CHECK(spline.u_patches() == 3);
  CHECK(spline.v_patches() == 5);
  CHECK(spline.u_basis[13] == Approx(4.0 / 6.0));
  CHECK(spline.v_basis[13] == 1);
  const auto& matrix = shape_of<PatchMesh>(
      "Basis [1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16] 2 \"hermite\" 2 Patch \"bicubic\"" +
      points(16));
  CHECK(matrix.u_basis[1] == 2);
  CHECK(matrix.v_step == 2);
  const auto& bilinear =
      shape_of<PatchMesh>("PatchMesh \"bilinear\" 3 \"periodic\" 2 \"nonperiodic\"" + points(6));
  CHECK(bilinear.u_patches() == 3);
  CHECK(bilinear.v_patches() == 1);
  // Partition of unity: the rows of a point basis sum to (0, 0, 0, 1).
  for (const char* name : {"bezier", "b-spline", "catmull-rom"}) {
    const auto& mesh = shape_of<PatchMesh>(
        fmt::format("Basis \"{}\" 1 \"{}\" Patch \"bicubic\"", name, name) + points(16));
    for (int row = 0; row < 4; ++row) {
      double sum = 0;
      for (int i = 0; i < 4; ++i) sum += mesh.u_basis[size_t(4 * row + i)];
      CHECK(sum == Approx(row == 3 ? 1.0 : 0.0).margin(1e-12));
    }
  }
}

TEST_CASE("heights and homogeneous points") {
  const auto& heights = geometry_of(
      "PatchMesh \"bilinear\" 3 \"nonperiodic\" 2 \"nonperiodic\" "
      "\"Pz\" [1 2 3 4 5 6]");
  CHECK(heights.P_object[0][4] == glm::vec3(0.5f, 1, 5));
  CHECK(geometry_of("Patch \"bilinear\" \"Pw\" [0 0 0 2 2 0 0 2 0 2 0 2 2 2 0 2]").P_object[0][3] ==
        glm::vec3(1, 1, 0));
  CHECK(last_read.warnings.empty());
  geometry_of("Patch \"bilinear\" \"Pw\" [0 0 0 1 2 0 0 2 0 2 0 2 2 2 0 2]");
  CHECK(last_read.warnings.size() == 1);
}

TEST_CASE("NURBS keep their weights") {
  const std::string head = "NuPatch 3 3 [0 0 0 1 1 1] 0 1 2 2 [0 0 1 1] 0 1 ";
  const auto& rational =
      geometry_of(head + "\"Pw\" [1 0 0 1  1 1 0 1  0 2 0 2  1 0 1 1  1 1 1 1  0 2 2 2]");
  const auto& nurbs = std::get<NurbsPatch>(rational.shape);
  REQUIRE(nurbs.weights.size() == 1);
  CHECK(nurbs.weights[0] == std::vector<float>{1, 1, 2, 1, 1, 2});
  CHECK(rational.P_object[0][2] == glm::vec3(0, 1, 0));
  CHECK(nurbs.u_knots.size() == 6);
  CHECK(shape_of<NurbsPatch>(head + points(6)).weights.empty());
}

TEST_CASE("quadrics in both argument forms") {
  CHECK(shape_of<Quadric>("Sphere 2 -1 1 270").parameters[0] == std::vector<double>{2, -1, 1, 270});
  CHECK(shape_of<Quadric>("Sphere [2 -5 5 270]").parameters[0] ==
        std::vector<double>{2, -2, 2, 270});
  CHECK(shape_of<Quadric>("Cone 2 1 360").kind == Quadric::Kind::cone);
  CHECK(shape_of<Quadric>("Cylinder [1 0 2 90]").kind == Quadric::Kind::cylinder);
  CHECK(shape_of<Quadric>("Hyperboloid [1 0 0] [1 1 1] 360").parameters[0].size() == 7);
  CHECK(shape_of<Quadric>("Hyperboloid 1 0 0 1 1 1 360").parameters[0].size() == 7);
  CHECK(shape_of<Quadric>("Paraboloid 1 0 2 360").kind == Quadric::Kind::paraboloid);
  CHECK(shape_of<Quadric>("Disk 1 .5 360").kind == Quadric::Kind::disk);
  const auto& torus = geometry_of("Torus 2 .5 0 360 360 \"Cs\" [1 0 0 0 1 0 0 0 1 1 1 1]");
  CHECK(std::get<Quadric>(torus.shape).parameters[0][1] == .5);
  CHECK(torus.primvars.at(0).value_count() == 4);
}

TEST_CASE("primitive variables: every class on a patch mesh and on a mesh") {
  const std::string mesh = "PatchMesh \"bicubic\" 7 \"nonperiodic\" 4 \"nonperiodic\"" + points(28);
  const auto& patch = geometry_of(mesh + R"(
    "constant float a" 1  "uniform float b" [1 2]  "varying float c" [1 2 3 4 5 6]
    "facevarying float d" [1 2 3 4 5 6 7 8]  "vertex float[2] e" [)" +
                                  [] {
                                    std::string s;
                                    for (int i = 0; i < 56; ++i) s += "0 ";
                                    return s;
                                  }() +
                                  R"(]
    "constant string f" ["x"]  "uniform matrix g" [1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1
                                                    1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1])");
  REQUIRE(patch.primvars.size() == 7);
  CHECK(patch.primvars[1].storage == StorageClass::uniform);
  CHECK(patch.primvars[4].value_count() == 28);
  CHECK(patch.primvars[5].strings.at(0) == "x");
  for (const char* wrong :
       {"\"constant float a\" [1 2]", "\"uniform float b\" 1", "\"varying float c\" [1 2 3]",
        "\"facevarying float d\" [1 2]", "\"vertex float e\" [1]"})
    CHECK_THAT(error_in_world("\n" + mesh + wrong),
               Contains("test.rib:2: ") && Contains("expected"));
  CHECK(error_in_world("\nPolygon" + points(4) + "\"st\" [0 0 1 0 1 1]") ==
        "test.rib:2: \"st\" (varying): expected 4 values, found 3");
}

TEST_CASE("malformed shapes are refused with line and expectation") {
  const std::vector<std::pair<std::string, const char*>> table = {
      {"PointsPolygons [3] [0 1 9]" + points(3), "vertex index 9 is out of range: expected 0 to 2"},
      {"PointsPolygons [3] [0 1 -1]" + points(3), "vertex index -1"},
      {"PointsPolygons [3 3] [0 1 2]" + points(3), "add up to 6, but 3 values follow"},
      {"PointsPolygons [2] [0 1]" + points(3), "expected at least 3"},
      {"PointsPolygons [] []" + points(3), "found none"},
      {"PointsGeneralPolygons [2] [3] [0 1 2]" + points(3), "add up to 2, but 1"},
      {"PointsPolygons [3] [0 1 2.5]" + points(3), "expected an integer, found 2.5"},
      {"PointsPolygons [2000000000 2000000000] [0 1 2]" + points(3), "add up to 4000000000"},
      {"GeneralPolygon [4 4]" + points(7), "add up to 8, but 7"},
      {"Polygon \"st\" [0 0]", "expected a parameter \"P\""},
      {"Polygon \"P\" [0 0 0 1]", "expected a multiple of 3, found 4"},
      {"Polygon \"P\" [\"a\"]", "expected numbers"},
      {"Polygon \"P\"", "expected a value for the parameter \"P\""},
      {"Polygon \"P\" [0 0 nan]", "finite number, found nan"},
      {"Polygon \"P\" [0 0 1e39 0 0 0 0 0 0]", "range of float"},
      {"Polygon \"uniform flat P\" 1", "expected a parameter such as"},
      {"Patch \"bicubic\"" + points(15), "expected 4 x 4 = 16 control points, found 15"},
      {"Patch \"cubic\"" + points(16), "\"bilinear\" or \"bicubic\""},
      {"PatchMesh \"bicubic\" 5 \"nonperiodic\" 4 \"nonperiodic\"" + points(20), "basis step"},
      {"PatchMesh \"bilinear\" 2000000000 \"nonperiodic\" 2000000000 \"nonperiodic\"" + points(4),
       "4000000000000000000 control points"},
      {"PatchMesh \"bilinear\" -2 \"nonperiodic\" -2 \"nonperiodic\"" + points(4), "at least 2"},
      {"Patch \"bilinear\" \"Pw\" [0 0 0 1 0 0 0 1 0 0 0 1 0 0 0 0]", "positive weights, found 0"},
      {"Basis \"bezier\" 0 \"bezier\" 3", "step of at least 1"},
      {"Basis \"cubic\" 1 \"bezier\" 3", "\"catmull-rom\""},
      {"NuPatch 3 3 [0 0 0 1 1] 0 1 2 2 [0 0 1 1] 0 1" + points(6), "= 6 u knots, found 5"},
      {"NuPatch 3 3 [0 0 1 0 1 1] 0 1 2 2 [0 0 1 1] 0 1" + points(6), "do not ascend"},
      {"NuPatch 3 3 [0 0 0 1 1 1] 0 2 2 2 [0 0 1 1] 0 1" + points(6), "umin < umax within"},
      {"NuPatch 2 3 [0 0 0 1 1] 0 1 2 2 [0 0 1 1] 0 1" + points(4), "at least the order"},
      {"SubdivisionMesh \"loop\" [4] [0 1 2 3]" + points(4), "triangles only"},
      {"SubdivisionMesh \"bilinear\" [4] [0 1 2 3]" + points(4), "\"catmull-clark\" or \"loop\""},
      {"SubdivisionMesh \"catmull-clark\" [4] [0 1 2 3] [\"hole\"] [1 0] [1] []" + points(4),
       "hole face index 1"},
      {"SubdivisionMesh \"catmull-clark\" [4] [0 1 2 3] [\"crease\"] [3 1] [1 2] [1]" + points(4),
       "expected 3 arguments, found 2 left"},
      {"SubdivisionMesh \"catmull-clark\" [4] [0 1 2 3] [\"crease\"] [2] [1 2] [1]" + points(4),
       "two argument counts"},
      {"SubdivisionMesh \"catmull-clark\" [4] [0 1 2 3] [\"corner\"] [1 1] [8] [1]" + points(4),
       "corner vertex index 8"},
      {"Sphere 1 -1 1", "Sphere: expected 4 numbers, found 3"},
      {"Sphere [1 -1 1 360 5]", "expected 4 numbers, found 5"},
      {"Sphere 1 -1 1 360 5", "expected the name of a parameter, found the number 5"},
      {"Sphere \"a\"", "found the string \"a\" after 0 of them"},
      {"Paraboloid 1 -1 -2 360", "0 <= zmin"}};
  for (const auto& [text, message] : table) {
    CAPTURE(text);
    CHECK_THAT(error_in_world("\n\n" + text), Contains(message) && Contains("test.rib:3: "));
  }
  CHECK_THAT(error_of("Sphere 1 -1 1 360"), Contains("outside of any world"));
}
