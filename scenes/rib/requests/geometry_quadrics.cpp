/// Quadrics and the torus.

#include "scenes/rib/request.h"

namespace tessera {

namespace {

/// `count` numbers, one by one or in arrays, then primitive variables.
template <Quadric::Kind kind, size_t count>
void quadric(RibSession& session, RibArguments& arguments) {
  Quadric shape;
  shape.kind = kind;
  shape.parameters.push_back(arguments.numbers(count));
  session.calls().shape(
      {std::move(shape), arguments.parameters(session.declarations(), session.diagnostics())},
      arguments.where());
}

const RibRequestRow rows[] = {
    {"Sphere", quadric<Quadric::Kind::sphere, 4>},
    {"Cone", quadric<Quadric::Kind::cone, 3>},
    {"Cylinder", quadric<Quadric::Kind::cylinder, 4>},
    {"Hyperboloid", quadric<Quadric::Kind::hyperboloid, 7>},
    {"Paraboloid", quadric<Quadric::Kind::paraboloid, 4>},
    {"Disk", quadric<Quadric::Kind::disk, 3>},
    {"Torus", quadric<Quadric::Kind::torus, 5>},
};

}  // namespace

RibRequestTable rib_request_geometry_quadrics() { return {rows}; }

}  // namespace tessera
