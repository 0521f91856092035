/// Bilinear, bicubic and NURBS patches.

#include "scenes/rib/request.h"

namespace tessera {

namespace {

void give(RibSession& session, RibArguments& arguments, Shape shape) {
  session.calls().shape(
      {std::move(shape), arguments.parameters(session.declarations(), session.diagnostics())},
      arguments.where());
}

bool is_bicubic(RibArguments& arguments) {
  const std::string type = arguments.string();
  if (type != "bilinear" && type != "bicubic")
    arguments.fail("expected \"bilinear\" or \"bicubic\", found \"{:.60}\"", type);
  return type == "bicubic";
}

bool is_periodic(RibArguments& arguments) {
  const std::string wrap = arguments.string();
  if (wrap != "periodic" && wrap != "nonperiodic")
    arguments.fail("expected \"periodic\" or \"nonperiodic\", found \"{:.60}\"", wrap);
  return wrap == "periodic";
}

void patch(RibSession& session, RibArguments& arguments) {
  PatchMesh mesh;
  mesh.bicubic = is_bicubic(arguments);
  mesh.u_vertices = mesh.v_vertices = mesh.bicubic ? 4 : 2;
  give(session, arguments, std::move(mesh));
}

void patch_mesh(RibSession& session, RibArguments& arguments) {
  PatchMesh mesh;
  mesh.bicubic = is_bicubic(arguments);
  mesh.u_vertices = arguments.integer();
  mesh.u_periodic = is_periodic(arguments);
  mesh.v_vertices = arguments.integer();
  mesh.v_periodic = is_periodic(arguments);
  give(session, arguments, std::move(mesh));
}

void nu_patch(RibSession& session, RibArguments& arguments) {
  NurbsPatch patch;
  patch.u_vertices = arguments.integer();
  patch.u_order = arguments.integer();
  patch.u_knots = arguments.number_array();
  patch.u_min = arguments.number();
  patch.u_max = arguments.number();
  patch.v_vertices = arguments.integer();
  patch.v_order = arguments.integer();
  patch.v_knots = arguments.number_array();
  patch.v_min = arguments.number();
  patch.v_max = arguments.number();
  give(session, arguments, std::move(patch));
}

const RibRequestRow rows[] = {
    {"Patch", patch},
    {"PatchMesh", patch_mesh},
    {"NuPatch", nu_patch},
};

}  // namespace

RibRequestTable rib_request_geometry_patches() { return {rows}; }

}  // namespace tessera
