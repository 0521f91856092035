/// Requests that set attributes other than shaders.

#include "scenes/patch_basis.h"
#include "scenes/rib/request.h"

namespace tessera {

namespace {

void give(RibSession& session, const RibArguments& arguments, AttributeCall call) {
  session.calls().attribute(call, arguments.where());
}

void color(RibSession& session, RibArguments& arguments) {
  give(session, arguments, attribute_call::Color{arguments.color()});
}

void opacity(RibSession& session, RibArguments& arguments) {
  give(session, arguments, attribute_call::Opacity{arguments.color()});
}

void shading_rate(RibSession& session, RibArguments& arguments) {
  give(session, arguments, attribute_call::ShadingRate{arguments.number()});
}

void shading_interpolation(RibSession& session, RibArguments& arguments) {
  const std::string kind = arguments.string();
  if (kind != "smooth" && kind != "constant")
    arguments.fail("expected \"smooth\" or \"constant\", found \"{}\"", kind);
  give(session, arguments, attribute_call::ShadingInterpolation{kind == "smooth"});
}

void sides(RibSession& session, RibArguments& arguments) {
  give(session, arguments, attribute_call::Sides{arguments.integer()});
}

void orientation(RibSession& session, RibArguments& arguments) {
  using Kind = attribute_call::Orientation::Kind;
  const std::string name = arguments.string();
  attribute_call::Orientation call{};
  if (name == "outside")
    call.kind = Kind::outside;
  else if (name == "inside")
    call.kind = Kind::inside;
  else if (name == "lh")
    call.kind = Kind::left_handed;
  else if (name == "rh")
    call.kind = Kind::right_handed;
  else
    arguments.fail("expected \"outside\", \"inside\", \"lh\" or \"rh\", found \"{}\"", name);
  give(session, arguments, call);
}

void reverse_orientation(RibSession& session, RibArguments& arguments) {
  give(session, arguments, attribute_call::ReverseOrientation{});
}

void matte(RibSession& session, RibArguments& arguments) {
  give(session, arguments, attribute_call::Matte{arguments.boolean()});
}

void texture_coordinates(RibSession& session, RibArguments& arguments) {
  const std::vector<double> n = arguments.numbers(8);
  attribute_call::TextureCoordinates call{};
  for (size_t i = 0; i < 4; ++i) call.st[i] = {float(n[2 * i]), float(n[2 * i + 1])};
  give(session, arguments, call);
}

void geometric_approximation(RibSession& session, RibArguments& arguments) {
  std::string kind = arguments.string();
  const double value = arguments.number();
  give(session, arguments, attribute_call::GeometricApproximation{std::move(kind), value});
}

/// One direction of a basis: a name or 16 numbers, then the step. A named basis knows its own.
NamedBasis one_basis(RibArguments& arguments) {
  NamedBasis basis{};
  if (arguments.next_is_numbers()) {
    const std::vector<double> n = arguments.numbers(16);
    for (size_t i = 0; i < 16; ++i) basis.matrix[i] = n[i];
    basis.step = arguments.integer();
  } else {
    const std::string name = arguments.string();
    const std::optional<NamedBasis> found = named_basis(name);
    if (!found)
      arguments.fail(
          "expected \"bezier\", \"b-spline\", \"catmull-rom\", \"hermite\", \"power\" or "
          "a matrix, found \"{:.60}\"",
          name);
    basis = *found;
    if (arguments.next_is_numbers() && arguments.peek()->numbers.size() == 1)
      basis.step = arguments.integer();
  }
  if (basis.step < 1) arguments.fail("expected a step of at least 1, found {}", basis.step);
  return basis;
}

void basis(RibSession& session, RibArguments& arguments) {
  const NamedBasis u = one_basis(arguments);
  const NamedBasis v = one_basis(arguments);
  give(session, arguments, attribute_call::Basis{u.matrix, v.matrix, u.step, v.step});
}

void attribute(RibSession& session, RibArguments& arguments) {
  std::string category = arguments.string();
  give(session, arguments,
       attribute_call::User{std::move(category),
                            arguments.parameters(session.declarations(), session.diagnostics())});
}

const RibRequestRow rows[] = {
    {"Color", color},
    {"Opacity", opacity},
    {"ShadingRate", shading_rate},
    {"ShadingInterpolation", shading_interpolation},
    {"Sides", sides},
    {"Orientation", orientation},
    {"ReverseOrientation", reverse_orientation},
    {"Matte", matte},
    {"TextureCoordinates", texture_coordinates},
    {"GeometricApproximation", geometric_approximation},
    {"Basis", basis},
    {"Attribute", attribute},
};

}  // namespace

RibRequestTable rib_request_attributes() { return {rows}; }

}  // namespace tessera
