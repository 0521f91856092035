#include "scenes/shape_checks.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "scenes/mesh_edges.h"

namespace tessera {

namespace {

/// Checks one shape. Overloaded by kind of shape; throws Error at `where`.
class ShapeCheck {
 public:
  ShapeCheck(size_t control_points, const SourceLocation& where, Diagnostics& diagnostics)
      : points_(control_points), where_(where), diagnostics_(diagnostics) {}

  void operator()(SubdivisionMesh& mesh) const;
  void operator()(PolygonMesh& mesh) const;
  void operator()(PatchMesh& mesh) const;
  void operator()(NurbsPatch& patch) const;
  void operator()(Quadric& quadric) const;

 private:
  template <class... Args>
  [[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args) const {
    throw Error(where_, fmt::format(format, std::forward<Args>(args)...));
  }
  void check_counts(const char* what, const std::vector<int>& counts, int least,
                    size_t expected_sum) const;
  void check_indices(const char* what, const std::vector<int>& indices, size_t limit) const;
  void check_patch_axis(const char* axis, int vertices, int step, bool periodic,
                        bool bicubic) const;
  void check_knots(const char* axis, const std::vector<double>& knots, int vertices, int order,
                   double low, double high) const;
  void drop_unknown_creases(SubdivisionMesh& mesh) const;

  size_t points_;
  const SourceLocation& where_;
  Diagnostics& diagnostics_;
};

void ShapeCheck::check_counts(const char* what, const std::vector<int>& counts, int least,
                              size_t expected_sum) const {
  if (counts.empty()) fail("expected at least one {}, found none", what);
  size_t sum = 0;
  for (int count : counts) {
    if (count < least) fail("found a {} of {}, expected at least {}", what, count, least);
    sum += size_t(count);
  }
  if (sum != expected_sum)
    fail("the {}s add up to {}, but {} values follow", what, sum, expected_sum);
}

void ShapeCheck::check_indices(const char* what, const std::vector<int>& indices,
                               size_t limit) const {
  for (int index : indices)
    if (index < 0 || size_t(index) >= limit)
      fail("{} index {} is out of range: expected 0 to {}", what, index, int64_t(limit) - 1);
}

void ShapeCheck::operator()(SubdivisionMesh& mesh) const {
  check_counts("face vertex count", mesh.face_vertex_counts, 3, mesh.face_vertices.size());
  check_indices("vertex", mesh.face_vertices, points_);
  if (mesh.scheme == SubdivisionMesh::Scheme::loop)
    for (int count : mesh.face_vertex_counts)
      if (count != 3) fail("a loop mesh has triangles only, found a face of {} vertices", count);
  check_indices("hole face", mesh.holes, mesh.face_vertex_counts.size());
  for (SubdivisionMesh::Corner& corner : mesh.corners) {
    check_indices("corner vertex", {corner.vertex}, points_);
    corner.sharpness = std::max(corner.sharpness, 0.0f);
  }
  for (SubdivisionMesh::Crease& crease : mesh.creases) {
    check_indices("crease vertex", {crease.v0, crease.v1}, points_);
    crease.sharpness = std::max(crease.sharpness, 0.0f);
  }
  drop_unknown_creases(mesh);
}

void ShapeCheck::drop_unknown_creases(SubdivisionMesh& mesh) const {
  if (mesh.creases.empty()) return;
  const MeshEdges edges(mesh.face_vertex_counts, mesh.face_vertices);
  std::erase_if(mesh.creases, [&](const SubdivisionMesh::Crease& crease) {
    if (edges.contains(crease.v0, crease.v1)) return false;
    diagnostics_.warn_once(
        "crease:" + where_.text(), where_,
        fmt::format("no edge joins vertices {} and {}: crease left out", crease.v0, crease.v1));
    return true;
  });
}

void ShapeCheck::operator()(PolygonMesh& mesh) const {
  check_counts("loop count", mesh.loops_per_polygon, 1, mesh.vertices_per_loop.size());
  check_counts("vertex count", mesh.vertices_per_loop, 3, mesh.vertices.size());
  check_indices("vertex", mesh.vertices, points_);
}

void ShapeCheck::check_patch_axis(const char* axis, int vertices, int step, bool periodic,
                                  bool bicubic) const {
  const int least = bicubic && !periodic ? 4 : 2;
  if (vertices < least) fail("expected n{} of at least {}, found {}", axis, least, vertices);
  if (!bicubic) return;
  if (step < 1) fail("expected a {} basis step of at least 1, found {}", axis, step);
  if ((periodic ? vertices : vertices - 4) % step != 0)
    fail("n{} = {} does not fit the {} basis step {}: expected {}", axis, vertices, axis, step,
         periodic ? "a multiple of the step" : "4 plus a multiple of the step");
}

void ShapeCheck::operator()(PatchMesh& mesh) const {
  check_patch_axis("u", mesh.u_vertices, mesh.u_step, mesh.u_periodic, mesh.bicubic);
  check_patch_axis("v", mesh.v_vertices, mesh.v_step, mesh.v_periodic, mesh.bicubic);
  const size_t expected = size_t(mesh.u_vertices) * size_t(mesh.v_vertices);
  if (points_ != expected)
    fail("expected {} x {} = {} control points, found {}", mesh.u_vertices, mesh.v_vertices,
         expected, points_);
}

void ShapeCheck::check_knots(const char* axis, const std::vector<double>& knots, int vertices,
                             int order, double low, double high) const {
  if (order < 2) fail("expected a {} order of at least 2, found {}", axis, order);
  if (vertices < order)
    fail("expected n{} of at least the order {}, found {}", axis, order, vertices);
  const size_t expected = size_t(vertices) + size_t(order);
  if (knots.size() != expected)
    fail("expected n{} + order = {} {} knots, found {}", axis, expected, axis, knots.size());
  if (!std::is_sorted(knots.begin(), knots.end())) fail("the {} knots do not ascend", axis);
  const double first = knots[size_t(order) - 1], last = knots[size_t(vertices)];
  if (!(low < high) || low < first || high > last)
    fail("expected {}min < {}max within the knots' [{}, {}], found {} and {}", axis, axis, first,
         last, low, high);
}

void ShapeCheck::operator()(NurbsPatch& patch) const {
  check_knots("u", patch.u_knots, patch.u_vertices, patch.u_order, patch.u_min, patch.u_max);
  check_knots("v", patch.v_knots, patch.v_vertices, patch.v_order, patch.v_min, patch.v_max);
  const size_t expected = size_t(patch.u_vertices) * size_t(patch.v_vertices);
  if (points_ != expected)
    fail("expected {} x {} = {} control points, found {}", patch.u_vertices, patch.v_vertices,
         expected, points_);
}

void ShapeCheck::operator()(Quadric& quadric) const {
  static constexpr size_t counts[] = {4, 3, 4, 7, 4, 3, 5};
  static constexpr const char* names[] = {"sphere",     "cone", "cylinder", "hyperboloid",
                                          "paraboloid", "disk", "torus"};
  std::vector<double>& p = quadric.parameters.at(0);
  const size_t expected = counts[int(quadric.kind)];
  if (p.size() != expected)
    fail("a {} has {} parameters, found {}", names[int(quadric.kind)], expected, p.size());
  if (quadric.kind == Quadric::Kind::sphere) {
    const double radius = std::abs(p[0]);
    p[1] = std::clamp(p[1], -radius, radius);
    p[2] = std::clamp(p[2], -radius, radius);
  }
  if (quadric.kind == Quadric::Kind::paraboloid && (std::min(p[1], p[2]) < 0.0 || p[2] == 0.0))
    fail("a paraboloid needs 0 <= zmin and 0 < zmax, found {} and {}", p[1], p[2]);
}

bool same_creases(const SubdivisionMesh& a, const SubdivisionMesh& b) {
  const auto same_edge = [](const SubdivisionMesh::Crease& c, const SubdivisionMesh::Crease& d) {
    return c.v0 == d.v0 && c.v1 == d.v1;
  };
  return std::equal(a.creases.begin(), a.creases.end(), b.creases.begin(), b.creases.end(),
                    same_edge);
}

struct SameTopology {
  bool operator()(const SubdivisionMesh& a, const SubdivisionMesh& b) const {
    return a.scheme == b.scheme && a.face_vertex_counts == b.face_vertex_counts &&
           a.face_vertices == b.face_vertices && a.holes == b.holes && a.boundary == b.boundary &&
           a.facevarying_boundary == b.facevarying_boundary && same_creases(a, b) &&
           a.corners.size() == b.corners.size();
  }
  bool operator()(const PolygonMesh& a, const PolygonMesh& b) const {
    return a.loops_per_polygon == b.loops_per_polygon &&
           a.vertices_per_loop == b.vertices_per_loop && a.vertices == b.vertices;
  }
  bool operator()(const PatchMesh& a, const PatchMesh& b) const {
    return a.bicubic == b.bicubic && a.u_vertices == b.u_vertices && a.v_vertices == b.v_vertices &&
           a.u_periodic == b.u_periodic && a.v_periodic == b.v_periodic && a.u_basis == b.u_basis &&
           a.v_basis == b.v_basis && a.u_step == b.u_step && a.v_step == b.v_step;
  }
  bool operator()(const NurbsPatch& a, const NurbsPatch& b) const {
    return a.u_vertices == b.u_vertices && a.u_order == b.u_order && a.v_vertices == b.v_vertices &&
           a.v_order == b.v_order && a.u_knots == b.u_knots && a.v_knots == b.v_knots &&
           a.u_min == b.u_min && a.u_max == b.u_max && a.v_min == b.v_min && a.v_max == b.v_max;
  }
  bool operator()(const Quadric& a, const Quadric& b) const { return a.kind == b.kind; }
  template <class A, class B>
  bool operator()(const A&, const B&) const {
    return false;
  }
};

struct CountPrimvars {
  size_t points;

  PrimvarCounts operator()(const SubdivisionMesh& mesh) const {
    return {mesh.face_vertex_counts.size(), points, points, mesh.face_vertices.size()};
  }
  PrimvarCounts operator()(const PolygonMesh& mesh) const {
    return {mesh.loops_per_polygon.size(), points, points, mesh.vertices.size()};
  }
  PrimvarCounts operator()(const PatchMesh& mesh) const {
    const size_t u = size_t(mesh.u_patches()), v = size_t(mesh.v_patches());
    const size_t varying = (u + (mesh.u_periodic ? 0 : 1)) * (v + (mesh.v_periodic ? 0 : 1));
    return {u * v, varying, points, 4 * u * v};
  }
  PrimvarCounts operator()(const NurbsPatch& patch) const {
    const size_t u = size_t(1 + patch.u_vertices - patch.u_order);
    const size_t v = size_t(1 + patch.v_vertices - patch.v_order);
    return {u * v, (u + 1) * (v + 1), points, 4 * u * v};
  }
  PrimvarCounts operator()(const Quadric&) const { return {1, 4, 4, 4}; }
};

}  // namespace

size_t PrimvarCounts::of(StorageClass storage) const {
  switch (storage) {
    case StorageClass::constant:
      return 1;
    case StorageClass::uniform:
      return uniform;
    case StorageClass::varying:
      return varying;
    case StorageClass::vertex:
      return vertex;
    case StorageClass::facevarying:
      return facevarying;
  }
  return 1;
}

PrimvarCounts primvar_counts(const Shape& shape, size_t control_points) {
  return std::visit(CountPrimvars{control_points}, shape);
}

void check_shape(Shape& shape, size_t control_points, const SourceLocation& where,
                 Diagnostics& diagnostics) {
  std::visit(ShapeCheck(control_points, where, diagnostics), shape);
}

bool same_topology(const Shape& a, const Shape& b) { return std::visit(SameTopology{}, a, b); }

}  // namespace tessera
