/// Polygons in their four forms, all of them polygon meshes.

#include <numeric>

#include "scenes/rib/request.h"

namespace tessera {

namespace {

void give(RibSession& session, const RibArguments& arguments, PolygonMesh mesh,
          std::vector<Parameter> parameters) {
  session.calls().shape({std::move(mesh), std::move(parameters)}, arguments.where());
}

std::vector<Parameter> parameters(RibSession& session, RibArguments& arguments) {
  return arguments.parameters(session.declarations(), session.diagnostics());
}

/// Vertex indices 0, 1, 2, ... for polygons that share no vertices.
std::vector<int> in_order(size_t count) {
  std::vector<int> indices(count);
  std::iota(indices.begin(), indices.end(), 0);
  return indices;
}

void polygon(RibSession& session, RibArguments& arguments) {
  std::vector<Parameter> given = parameters(session, arguments);
  const Parameter* P = find_parameter(given, "P");
  if (!P) P = find_parameter(given, "Pw");
  if (!P) arguments.fail("expected a parameter \"P\", found none");
  const size_t count = P->value_count();
  give(session, arguments, {{1}, {int(count)}, in_order(count)}, std::move(given));
}

void general_polygon(RibSession& session, RibArguments& arguments) {
  PolygonMesh mesh;
  mesh.vertices_per_loop = arguments.integer_array();
  mesh.loops_per_polygon = {int(mesh.vertices_per_loop.size())};
  std::vector<Parameter> given = parameters(session, arguments);
  // The number of vertices is that of the points, so that no count alone makes us allocate.
  const Parameter* P = find_parameter(given, "P");
  if (!P) P = find_parameter(given, "Pw");
  if (!P) arguments.fail("expected a parameter \"P\", found none");
  mesh.vertices = in_order(P->value_count());
  give(session, arguments, std::move(mesh), std::move(given));
}

void points_polygons(RibSession& session, RibArguments& arguments) {
  PolygonMesh mesh;
  mesh.vertices_per_loop = arguments.integer_array();
  mesh.loops_per_polygon.assign(mesh.vertices_per_loop.size(), 1);
  mesh.vertices = arguments.integer_array();
  give(session, arguments, std::move(mesh), parameters(session, arguments));
}

void points_general_polygons(RibSession& session, RibArguments& arguments) {
  PolygonMesh mesh;
  mesh.loops_per_polygon = arguments.integer_array();
  mesh.vertices_per_loop = arguments.integer_array();
  mesh.vertices = arguments.integer_array();
  give(session, arguments, std::move(mesh), parameters(session, arguments));
}

const RibRequestRow rows[] = {
    {"Polygon", polygon},
    {"GeneralPolygon", general_polygon},
    {"PointsPolygons", points_polygons},
    {"PointsGeneralPolygons", points_general_polygons},
};

}  // namespace

RibRequestTable rib_request_geometry_polygons() { return {rows}; }

}  // namespace tessera
