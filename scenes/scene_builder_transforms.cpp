/// SceneBuilder: the current transform and named coordinate systems.

#include "scenes/scene_builder.h"

namespace tessera {

namespace {

/// Whether the matrix maps points to points: its last row is (0, 0, 0, w), w not zero.
bool is_affine(const glm::dmat4& matrix) {
  return matrix[0][3] == 0.0 && matrix[1][3] == 0.0 && matrix[2][3] == 0.0 && matrix[3][3] != 0.0;
}

}  // namespace

int SceneBuilder::current_handedness() const {
  // An object definition starts in a space of its own, left-handed as camera space is.
  const bool in_world = inside(BlockKind::world) && !inside(BlockKind::object);
  return outer_from_current_.handedness() * (in_world ? camera_from_world_.handedness() : 1);
}

void SceneBuilder::transform(const TransformCall& call, const SourceLocation& where) {
  if (const auto* c = std::get_if<transform_call::Set>(&call)) set(c->matrix, where);
  if (const auto* c = std::get_if<transform_call::Concat>(&call)) concat(c->matrix, where);
  if (const auto* c = std::get_if<transform_call::Perspective>(&call))
    perspective(c->fov_degrees, where);
  if (const auto* c = std::get_if<transform_call::UseSpace>(&call)) use_space(c->name, where);
  if (const auto* c = std::get_if<transform_call::NameSpace>(&call)) {
    if (inside(BlockKind::object))
      diagnostics_.warn_once("space-in-object", where,
                             "a coordinate system cannot be named inside an object: left out");
    else if (takes_value("a coordinate system", where))
      definitions_.named_spaces[c->name] = outer_from_current_;
  }
}

std::optional<glm::dmat4> SceneBuilder::affine_part(const glm::dmat4& matrix,
                                                    const SourceLocation& where) {
  if (is_affine(matrix)) return matrix / matrix[3][3];
  diagnostics_.warn_once("projective", where,
                         "a projective matrix is not supported as a transform: left out");
  return std::nullopt;
}

void SceneBuilder::set(const glm::dmat4& matrix, const SourceLocation& where) {
  const std::optional<glm::dmat4> affine = affine_part(matrix, where);
  if (!affine) return;
  if (motion_)
    motion_->set_transform(*affine, where);
  else
    outer_from_current_ = KeyedTransform(*affine);
}

void SceneBuilder::concat(const glm::dmat4& matrix, const SourceLocation& where) {
  const std::optional<glm::dmat4> affine = affine_part(matrix, where);
  if (!affine) return;
  if (motion_)
    motion_->concat_transform(*affine, where);
  else
    outer_from_current_ = outer_from_current_ * KeyedTransform(*affine);
}

void SceneBuilder::perspective(double fov_degrees, const SourceLocation& where) {
  // As the first transform of an orthographic camera this is the same picture as the projection of
  // that name. Anywhere else it would bend straight motion and lines of dicing: not supported.
  const bool is_camera = !inside(BlockKind::world) && !inside(BlockKind::object) && !motion_ &&
                         outer_from_current_ == KeyedTransform() && !options_.projection_given;
  if (is_camera) {
    Parameter fov;
    fov.name = "fov";
    fov.numbers = {float(fov_degrees)};
    option(option_call::Projection{"perspective", {fov}}, where);
    return;
  }
  diagnostics_.warn_once("perspective", where,
                         "Perspective is supported as the first camera transform only: left out");
}

void SceneBuilder::use_space(const std::string& name, const SourceLocation& where) {
  const bool in_world = inside(BlockKind::world);
  const auto found = definitions_.named_spaces.find(name);
  KeyedTransform space;
  if (found != definitions_.named_spaces.end()) {
    space = found->second;
  } else if (name == "camera" && in_world) {
    space = camera_from_world_.inverse();
  } else if (name != "camera" && !(name == "world" && in_world)) {
    diagnostics_.warn_once("space:" + name, where,
                           fmt::format("no coordinate system is called \"{}\": left out", name));
    return;
  }
  if (!motion_)
    outer_from_current_ = space;
  else
    motion_->set_transform(space.matrices().front(), where);
}

}  // namespace tessera
