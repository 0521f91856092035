#include "scenes/keyed_shape.h"

#include "scenes/control_points.h"
#include "scenes/shape_checks.h"

namespace tessera {

namespace {

const char* const point_names[] = {"P", "Pw", "Pz"};

bool holds_points(const Parameter& parameter) {
  for (const char* name : point_names)
    if (parameter.name == name) return true;
  return false;
}

void check_primvar(const Parameter& parameter, const PrimvarCounts& counts,
                   const SourceLocation& where) {
  const size_t expected = counts.of(parameter.storage);
  const size_t found = parameter.value_count();
  if (found != expected)
    throw Error(where, fmt::format("\"{}\" ({}): expected {} values, found {}", parameter.name,
                                   name_of(parameter.storage), expected, found));
}

/// Missing weights are ones, so that keys with and without "Pw" go together.
void match_weights(NurbsPatch& a, NurbsPatch& b, size_t keys, size_t points) {
  if (a.weights.empty() && b.weights.empty()) return;
  if (a.weights.empty()) a.weights.assign(keys, std::vector<float>(points, 1.0f));
  if (b.weights.empty()) b.weights.assign(1, std::vector<float>(points, 1.0f));
  a.weights.push_back(std::move(b.weights.front()));
}

template <class Array>
Array blend_arrays(const std::vector<Array>& keys, const ShutterKey& key) {
  using Value = typename Array::value_type;
  Array result = keys[key.before];
  if (key.weight == 0.0) return result;
  const Array& after = keys[key.after];
  for (size_t i = 0; i < result.size(); ++i) {
    if constexpr (std::is_floating_point_v<Value>)
      result[i] = Value((1.0 - key.weight) * double(result[i]) + key.weight * double(after[i]));
    else
      result[i] =
          Value((1.0 - key.weight) * glm::dvec3(result[i]) + key.weight * glm::dvec3(after[i]));
  }
  return result;
}

template <class Array>
void rekey(std::vector<Array>& values, const std::vector<ShutterKey>& keys) {
  if (values.empty()) return;
  std::vector<Array> result;
  for (const ShutterKey& key : keys) result.push_back(blend_arrays(values, key));
  values = std::move(result);
}

}  // namespace

KeyedShape build_shape(ShapeCall call, const attribute_call::Basis& basis,
                       const SourceLocation& where, Diagnostics& diagnostics) {
  KeyedShape result;
  Geometry& geometry = result.geometry;
  geometry.shape = std::move(call.shape);
  geometry.where = where;
  if (auto* mesh = std::get_if<PatchMesh>(&geometry.shape); mesh && mesh->bicubic) {
    mesh->u_basis = basis.u, mesh->u_step = basis.u_step;
    mesh->v_basis = basis.v, mesh->v_step = basis.v_step;
  }
  size_t points = 0;
  if (!std::holds_alternative<Quadric>(geometry.shape)) {
    ControlPoints control = take_control_points(call.parameters, geometry.shape, where);
    points = control.P.size();
    if (auto* nurbs = std::get_if<NurbsPatch>(&geometry.shape)) {
      if (!control.weights.empty()) nurbs->weights.push_back(std::move(control.weights));
    } else if (!control.weights.empty()) {
      diagnostics.warn_once("rational-patch", where,
                            "weights of \"Pw\" differ: kept on NuPatch only, ignored here");
    }
    geometry.P_object.push_back(std::move(control.P));
  }
  check_shape(geometry.shape, points, where, diagnostics);
  const PrimvarCounts counts = primvar_counts(geometry.shape, points);
  for (Parameter& parameter : call.parameters) {
    if (holds_points(parameter)) continue;
    check_primvar(parameter, counts, where);
    geometry.primvars.push_back(std::move(parameter));
  }
  return result;
}

void append_key(KeyedShape& shape, KeyedShape next, double time) {
  Geometry& geometry = shape.geometry;
  Geometry& added = next.geometry;
  const size_t keys = shape.scene_times.size();
  const bool same_points =
      geometry.P_object.empty() || geometry.P_object[0].size() == added.P_object[0].size();
  if (!same_topology(geometry.shape, added.shape) || !same_points)
    throw Error(added.where,
                fmt::format("the shapes of a motion block must differ in their points only; this "
                            "one differs from that of {} in kind, counts or indices",
                            geometry.where.text()));
  if (auto* quadric = std::get_if<Quadric>(&geometry.shape))
    quadric->parameters.push_back(std::get<Quadric>(added.shape).parameters.front());
  if (auto* nurbs = std::get_if<NurbsPatch>(&geometry.shape))
    match_weights(*nurbs, std::get<NurbsPatch>(added.shape), keys, geometry.P_object[0].size());
  if (!geometry.P_object.empty()) geometry.P_object.push_back(std::move(added.P_object.front()));
  shape.scene_times.push_back(time);
}

Geometry in_shutter(KeyedShape shape, ShutterInterval shutter) {
  Geometry geometry = std::move(shape.geometry);
  const std::vector<ShutterKey> keys = shutter_keys(shape.scene_times, shutter);
  geometry.key_times.clear();
  for (const ShutterKey& key : keys) geometry.key_times.push_back(key.t);
  if (shape.scene_times.size() == 1) return geometry;
  rekey(geometry.P_object, keys);
  if (auto* quadric = std::get_if<Quadric>(&geometry.shape)) rekey(quadric->parameters, keys);
  if (auto* nurbs = std::get_if<NurbsPatch>(&geometry.shape)) rekey(nurbs->weights, keys);
  return geometry;
}

}  // namespace tessera
