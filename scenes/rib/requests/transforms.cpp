/// Requests that change the current transform. Positive angles turn by the left-hand rule in a
/// left-handed space, which is the ordinary rotation matrix.

#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "scenes/rib/request.h"

namespace tessera {

namespace {

void give(RibSession& session, const RibArguments& arguments, TransformCall call) {
  session.calls().transform(call, arguments.where());
}

void identity(RibSession& session, RibArguments& arguments) {
  give(session, arguments, transform_call::Set{glm::dmat4(1.0)});
}

void transform(RibSession& session, RibArguments& arguments) {
  give(session, arguments, transform_call::Set{arguments.matrix()});
}

void concat_transform(RibSession& session, RibArguments& arguments) {
  give(session, arguments, transform_call::Concat{arguments.matrix()});
}

void perspective(RibSession& session, RibArguments& arguments) {
  const double fov_degrees = arguments.number();
  if (!(fov_degrees > 0 && fov_degrees < 180))
    arguments.fail("expected degrees between 0 and 180, found {}", fov_degrees);
  give(session, arguments, transform_call::Perspective{fov_degrees});
}

void translate(RibSession& session, RibArguments& arguments) {
  const std::vector<double> n = arguments.numbers(3);
  give(session, arguments,
       transform_call::Concat{glm::translate(glm::dmat4(1.0), {n[0], n[1], n[2]})});
}

void rotate(RibSession& session, RibArguments& arguments) {
  const std::vector<double> n = arguments.numbers(4);
  const glm::dvec3 axis(n[1], n[2], n[3]);
  if (glm::length(axis) == 0.0) arguments.fail("expected an axis with a length, found 0 0 0");
  give(session, arguments,
       transform_call::Concat{glm::rotate(glm::dmat4(1.0), glm::radians(n[0]), axis)});
}

void scale(RibSession& session, RibArguments& arguments) {
  const std::vector<double> n = arguments.numbers(3);
  give(session, arguments, transform_call::Concat{glm::scale(glm::dmat4(1.0), {n[0], n[1], n[2]})});
}

/// Skew angle dx1 dy1 dz1 dx2 dy2 dz2: shears along the second vector so that the first turns
/// towards it by `angle`. With b the unit second vector and a the unit part of the first normal to
/// it, the first is d = sin(p) b + cos(p) a; it shall become d' of the same height along a but
/// turned: d' . b / d' . a = tan(p + angle). Hence P' = P + (tan(p + angle) - tan(p)) (P . a) b.
void skew(RibSession& session, RibArguments& arguments) {
  const std::vector<double> n = arguments.numbers(7);
  const glm::dvec3 first(n[1], n[2], n[3]), second(n[4], n[5], n[6]);
  const glm::dvec3 normal = first * glm::dot(second, second) - second * glm::dot(first, second);
  if (!(glm::length(normal) > 0.0)) arguments.fail("expected two vectors of different directions");
  const glm::dvec3 b = glm::normalize(second), a = glm::normalize(normal);
  const double before = std::atan2(glm::dot(first, b), glm::dot(first, a));
  const double after = before + glm::radians(n[0]);
  if (!(std::abs(after) < glm::radians(90.0) - 1e-9))
    arguments.fail(
        "found an angle of {} degrees, which turns the first vector past the second or "
        "its opposite",
        n[0]);
  const glm::dvec3 shear = (std::tan(after) - std::tan(before)) * b;
  glm::dmat4 matrix(1.0);
  for (int axis = 0; axis < 3; ++axis) matrix[axis] += glm::dvec4(shear * a[axis], 0.0);
  give(session, arguments, transform_call::Concat{matrix});
}

void coordinate_system(RibSession& session, RibArguments& arguments) {
  give(session, arguments, transform_call::NameSpace{arguments.handle()});
}

void coord_sys_transform(RibSession& session, RibArguments& arguments) {
  give(session, arguments, transform_call::UseSpace{arguments.handle()});
}

const RibRequestRow rows[] = {
    {"Identity", identity},
    {"Transform", transform},
    {"ConcatTransform", concat_transform},
    {"Perspective", perspective},
    {"Translate", translate},
    {"Rotate", rotate},
    {"Scale", scale},
    {"Skew", skew},
    {"CoordinateSystem", coordinate_system},
    {"ScopedCoordinateSystem", coordinate_system},
    {"CoordSysTransform", coord_sys_transform},
};

}  // namespace

RibRequestTable rib_request_transforms() { return {rows}; }

}  // namespace tessera
