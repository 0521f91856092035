#pragma once
/// Shapes as the scene file gives them, checked: every index is in range, every count adds up.

#include <array>
#include <variant>
#include <vector>

#include <glm/glm.hpp>

#include "scenes/parameter.h"

namespace tessera {

/// A control mesh refined by Catmull-Clark or Loop rules.
struct SubdivisionMesh {
  enum class Scheme { catmull_clark, loop };
  enum class Boundary { none, edge_and_corner, edge_only };  // interpolateboundary 0, 1, 2

  Scheme scheme = Scheme::catmull_clark;
  std::vector<int> face_vertex_counts;  ///< all 3 for loop
  std::vector<int> face_vertices;       ///< vertex indices, face after face
  struct Crease {
    int v0, v1;  ///< an edge of the mesh
    float sharpness;
  };
  std::vector<Crease> creases;
  struct Corner {
    int vertex;
    float sharpness;
  };
  std::vector<Corner> corners;
  std::vector<int> holes;  ///< face indices
  Boundary boundary = Boundary::none;
  int facevarying_boundary = 0;  ///< facevaryinginterpolateboundary as given: 0 none ... 3
};

/// Planar polygons that share vertices: each polygon is one outer loop and any number of holes.
struct PolygonMesh {
  std::vector<int> loops_per_polygon;
  std::vector<int> vertices_per_loop;
  std::vector<int> vertices;  ///< indices, loop after loop
};

/// A rectangular mesh of bilinear or bicubic patches.
struct PatchMesh {
  bool bicubic = false;
  int u_vertices = 2, v_vertices = 2;  ///< control points; index = v * u_vertices + u
  bool u_periodic = false, v_periodic = false;
  /// Rows of a basis matrix B: p(t) = [t^3 t^2 t 1] * B * [p0 p1 p2 p3]. Row-major, as in RIB.
  using Basis = std::array<double, 16>;
  Basis u_basis{}, v_basis{};
  int u_step = 3, v_step = 3;

  int u_patches() const { return patches(u_vertices, u_step, u_periodic); }
  int v_patches() const { return patches(v_vertices, v_step, v_periodic); }

 private:
  int patches(int vertices, int step, bool periodic) const {
    if (!bicubic) return periodic ? vertices : vertices - 1;
    return periodic ? vertices / step : (vertices - 4) / step + 1;
  }
};

/// A tensor-product rational B-spline (NuPatch). P_object holds points after division by weight.
struct NurbsPatch {
  int u_vertices = 0, u_order = 0, v_vertices = 0, v_order = 0;
  std::vector<double> u_knots, v_knots;
  double u_min = 0, u_max = 1, v_min = 0, v_max = 1;
  std::vector<std::vector<float>> weights;  ///< [key][vertex]; empty when all are 1
};

/// A quadric or torus swept about object-space z; parameters are keyed in shutter time.
struct Quadric {
  enum class Kind { sphere, cone, cylinder, hyperboloid, paraboloid, disk, torus };
  Kind kind = Kind::sphere;
  /// In the order of the RIB request:
  ///   sphere radius zmin zmax thetamax;  cone height radius thetamax;
  ///   cylinder radius zmin zmax thetamax;  hyperboloid x1 y1 z1 x2 y2 z2 thetamax;
  ///   paraboloid rmax zmin zmax thetamax;  disk height radius thetamax;
  ///   torus majorrad minorrad phimin phimax thetamax.  Angles in degrees.
  std::vector<std::vector<double>> parameters;  ///< [key][...]
};

using Shape = std::variant<SubdivisionMesh, PolygonMesh, PatchMesh, NurbsPatch, Quadric>;

/// A shape with its points and primitive variables, shared by all instances of it.
///
/// Number of values of a primitive variable by storage class: constant 1; uniform one a face (mesh
/// face, polygon, or patch); vertex one a control point; varying one a parametric corner (the mesh
/// vertices for SubdivisionMesh and PolygonMesh; for PatchMesh (u_patches + (u_periodic ? 0 : 1)) *
/// the same in v; 4 for quadrics; for NurbsPatch (u segments + 1) * (v segments + 1), segments =
/// 1 + vertices - order); facevarying one a face corner, in the order of face_vertices.
/// Values are those of the first motion key. "P" is not in the list; "N", "Cs", "Os", "st", "s",
/// "t" are, under these names, when the scene gives them.
struct Geometry {
  Shape shape;
  std::vector<float> key_times{0.0f};            ///< shutter times, ascending; one key: static
  std::vector<std::vector<glm::vec3>> P_object;  ///< [key][control point]; empty for quadrics
  std::vector<Parameter> primvars;
  SourceLocation where;
};

}  // namespace tessera
