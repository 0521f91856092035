#include "scenes/control_points.h"

#include <algorithm>
#include <cmath>

namespace tessera {

namespace {

void expect_components(const Parameter& parameter, int components, const SourceLocation& where) {
  if (parameter.type != ValueType::string && parameter.floats_per_value() == components) return;
  throw Error(
      where, fmt::format("\"{}\": expected values of {} numbers, found type {}[{}]", parameter.name,
                         components, name_of(parameter.type), parameter.array_size));
}

ControlPoints from_points(const Parameter& parameter, const SourceLocation& where) {
  expect_components(parameter, 3, where);
  ControlPoints result;
  result.P.resize(parameter.value_count());
  for (size_t i = 0; i < result.P.size(); ++i) {
    const float* p = &parameter.numbers[3 * i];
    result.P[i] = {p[0], p[1], p[2]};
  }
  return result;
}

ControlPoints from_homogeneous(const Parameter& parameter, const SourceLocation& where) {
  expect_components(parameter, 4, where);
  ControlPoints result;
  const size_t count = parameter.value_count();
  result.P.resize(count);
  result.weights.resize(count);
  for (size_t i = 0; i < count; ++i) {
    const float* p = &parameter.numbers[4 * i];
    // Below this weight the division leaves the range of float for points of ordinary size.
    if (!(p[3] >= 1e-20f))
      throw Error(where, fmt::format("\"Pw\": expected positive weights, found {} at control point "
                                     "{}",
                                     p[3], i));
    result.P[i] = glm::vec3(glm::dvec3(p[0], p[1], p[2]) / double(p[3]));
    if (!std::isfinite(result.P[i].x) || !std::isfinite(result.P[i].y) ||
        !std::isfinite(result.P[i].z))
      throw Error(where, fmt::format("\"Pw\": control point {} divided by its weight is too large "
                                     "for a float",
                                     i));
    result.weights[i] = p[3];
  }
  const auto same = [&](float w) { return w == result.weights.front(); };
  if (std::all_of(result.weights.begin(), result.weights.end(), same)) result.weights.clear();
  return result;
}

ControlPoints from_heights(const Parameter& parameter, const Shape& shape,
                           const SourceLocation& where) {
  expect_components(parameter, 1, where);
  const PatchMesh* mesh = std::get_if<PatchMesh>(&shape);
  if (!mesh) throw Error(where, "\"Pz\" gives heights of patches; expected \"P\" here");
  const size_t width = size_t(std::max(mesh->u_vertices, 2));
  const size_t height = size_t(std::max(mesh->v_vertices, 2));
  ControlPoints result;
  result.P.resize(parameter.value_count());
  for (size_t i = 0; i < result.P.size(); ++i)
    result.P[i] = {float(i % width) / float(width - 1), float(i / width) / float(height - 1),
                   parameter.numbers[i]};
  return result;
}

}  // namespace

ControlPoints take_control_points(const std::vector<Parameter>& parameters, const Shape& shape,
                                  const SourceLocation& where) {
  if (const Parameter* P = find_parameter(parameters, "P")) return from_points(*P, where);
  if (const Parameter* Pw = find_parameter(parameters, "Pw")) return from_homogeneous(*Pw, where);
  if (const Parameter* Pz = find_parameter(parameters, "Pz"))
    return from_heights(*Pz, shape, where);
  throw Error(where, "found no control points; expected a parameter \"P\", \"Pw\" or \"Pz\"");
}

}  // namespace tessera
