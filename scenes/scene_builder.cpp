#include "scenes/scene_builder.h"

#include <utility>

namespace tessera {

namespace {

/// Real scenes nest a few dozen deep; this bounds what a broken file can make us hold.
constexpr size_t deepest_nesting = 4096;

}  // namespace

const char* name_of(BlockKind kind) {
  static constexpr const char* names[] = {"Frame",     "World",  "Attribute",
                                          "Transform", "Object", "Motion"};
  return names[int(kind)];
}

SceneBuilder::SceneBuilder(SceneSink& sink, Diagnostics& diagnostics, std::string file)
    : sink_(sink), diagnostics_(diagnostics), file_(std::move(file)) {}

bool SceneBuilder::inside(BlockKind kind) const {
  switch (kind) {
    case BlockKind::world:
      return scene_ != nullptr;
    case BlockKind::object:
      return object_.has_value();
    case BlockKind::motion:
      return motion_.has_value();
    default:
      break;
  }
  for (const OpenBlock& block : blocks_)
    if (block.kind == kind) return true;
  return false;
}

void SceneBuilder::check_block_allowed(const BlockCall& block, const SourceLocation& where) const {
  const auto refuse = [&](const char* outer) {
    throw Error(where, fmt::format("found {}Begin between {}Begin and its end, where it cannot be",
                                   name_of(block.kind), outer));
  };
  if (inside(BlockKind::motion)) refuse("Motion");
  if (block.kind == BlockKind::frame && !blocks_.empty()) refuse(name_of(blocks_.back().kind));
  if (block.kind == BlockKind::world && inside(BlockKind::world)) refuse("World");
  if (block.kind == BlockKind::world && inside(BlockKind::object)) refuse("Object");
  if (block.kind == BlockKind::object && inside(BlockKind::object)) refuse("Object");
  if (blocks_.size() >= deepest_nesting)
    throw Error(where, fmt::format("blocks are nested more than {} deep", deepest_nesting));
}

void SceneBuilder::begin(const BlockCall& block, const SourceLocation& where) {
  check_block_allowed(block, where);
  if (block.kind == BlockKind::motion) {
    motion_.emplace(block.motion_times, outer_from_current_, where);
    motion_value_taken_ = false;
  }
  OpenBlock open{block.kind, where, outer_from_current_, {}, {}, {}};
  const bool keeps_transform_only =
      block.kind == BlockKind::transform || block.kind == BlockKind::motion;
  if (!keeps_transform_only) open.attributes = attributes_;
  if (block.kind == BlockKind::frame || block.kind == BlockKind::world) {
    open.options = std::make_unique<OptionState>(options_);
    open.definitions = std::make_unique<Definitions>(definitions_);
  }
  blocks_.push_back(std::move(open));
  if (block.kind == BlockKind::frame) frame_number_ = block.frame_number;
  if (block.kind == BlockKind::world) begin_world();
  if (block.kind == BlockKind::object) begin_object(block.object_handle);
}

void SceneBuilder::begin_world() {
  camera_from_world_ = outer_from_current_;
  for (const glm::dmat4& matrix : camera_from_world_.matrices())
    if (glm::determinant(matrix) == 0.0)
      throw Error(blocks_.back().where, "the camera transform cannot be inverted");
  scene_ = std::make_unique<Scene>();
  // What was declared before the world is in camera space; from here on, outer space is the world.
  const KeyedTransform world_from_camera = camera_from_world_.inverse();
  const auto to_world = [&](KeyedTransform& space) {
    space = space == camera_from_world_ ? KeyedTransform() : world_from_camera * space;
  };
  for (KeyedLight& light : definitions_.lights) to_world(light.outer_from_light);
  for (auto& [name, space] : definitions_.named_spaces) to_world(space);
  attributes_.rebase(world_from_camera);
  outer_from_current_ = KeyedTransform();
}

void SceneBuilder::begin_object(const std::string& handle) {
  object_handle_ = handle;
  object_.emplace();
  attributes_.begin_object();
  outer_from_current_ = KeyedTransform();
}

void SceneBuilder::end(BlockKind kind, const SourceLocation& where) {
  if (blocks_.empty())
    throw Error(where, fmt::format("found {}End, but no block is open", name_of(kind)));
  if (blocks_.back().kind != kind)
    throw Error(where,
                fmt::format("found {}End, expected {}End for the block begun at {}", name_of(kind),
                            name_of(blocks_.back().kind), blocks_.back().where.text()));
  if (kind == BlockKind::motion) return end_motion(where);
  if (kind == BlockKind::world) end_world();
  if (kind == BlockKind::object) end_object();
  OpenBlock block = std::move(blocks_.back());
  blocks_.pop_back();
  outer_from_current_ = std::move(block.transform);
  if (block.attributes) {
    attributes_ = std::move(*block.attributes);
    object_attributes_.reset();
  }
  if (block.options) options_ = std::move(*block.options);
  if (block.definitions) definitions_ = std::move(*block.definitions);
  if (kind == BlockKind::frame) frame_number_ = 0;
}

void SceneBuilder::end_object() {
  definitions_.objects[object_handle_] =
      std::make_shared<const ObjectDefinition>(std::move(*object_));
  object_.reset();
  object_attributes_.reset();
}

void SceneBuilder::end_motion(const SourceLocation& where) {
  blocks_.pop_back();
  MotionBlock motion = std::move(*motion_);
  motion_.reset();
  motion.close(where);
  outer_from_current_ = motion.transform();
  if (!motion.shape()) return;
  const SourceLocation shape_where = motion.shape()->geometry.where;
  place(std::move(*motion.shape()), shape_where);
}

void SceneBuilder::end_world() {
  std::unique_ptr<Scene> scene = finished_scene();
  instanced_.clear();
  if (!sink_.frame(std::move(scene))) wants_more_ = false;
}

std::unique_ptr<Scene> SceneBuilder::finished_scene() {
  const ShutterInterval shutter = options_.shutter();
  Scene& scene = *scene_;
  scene.file = file_;
  scene.frame_number = frame_number_;
  scene.camera = options_.camera;
  scene.camera.camera_from_world = camera_from_world_.in_shutter(shutter);
  scene.options = options_.options;
  scene.displays = options_.displays;
  for (const KeyedLight& light : definitions_.lights)
    scene.lights.push_back({{light.call.name, light.call.parameters,
                             light.outer_from_light.in_shutter(shutter), light.where},
                            light.call.area,
                            light.call.handle,
                            light.shadow});
  for (const auto& [name, space] : definitions_.named_spaces)
    scene.coordinate_systems.emplace(name, space.in_shutter(shutter));
  return std::move(scene_);
}

bool SceneBuilder::takes_value(const char* what, const SourceLocation& where) {
  if (!motion_) return true;
  diagnostics_.warn_once(std::string("motion:") + what, where,
                         fmt::format("{} in a motion block: only its first value is used", what));
  return !std::exchange(motion_value_taken_, true);
}

void SceneBuilder::option(const OptionCall& call, const SourceLocation& where) {
  if (inside(BlockKind::world)) {
    diagnostics_.warn_once("option-in-world", where,
                           "options cannot change inside a world: left out");
    return;
  }
  if (const auto* make = std::get_if<option_call::MakeShadow>(&call)) {
    return sink_.make_shadow(make->picture, make->shadow, where);
  }
  if (takes_value("an option", where)) options_.apply(call, where, diagnostics_);
}

void SceneBuilder::attribute(const AttributeCall& call, const SourceLocation& where) {
  if (!takes_value("an attribute", where)) return;
  object_attributes_.reset();
  attributes_.apply(call, {outer_from_current_, current_handedness(), definitions_.light_handles,
                           definitions_.named_spaces, where, diagnostics_});
}

void SceneBuilder::light(const LightCall& call, const SourceLocation& where) {
  if (inside(BlockKind::object)) {
    diagnostics_.warn_once("light-in-object", where,
                           "a light cannot be part of an object definition: left out");
    return;
  }
  if (!takes_value("a light", where)) return;
  if (call.area && call.name.empty()) return attributes_.set_area_light(std::nullopt);
  const int index = int(definitions_.lights.size());
  definitions_.lights.push_back({call, outer_from_current_, where, attributes_.light_shadow()});
  definitions_.light_handles[call.handle] = index;
  attributes_.switch_light(index, true);
  if (call.area) attributes_.set_area_light(index);
}

void SceneBuilder::finish(const SourceLocation& where) {
  if (blocks_.empty()) return;
  const OpenBlock& block = blocks_.back();
  throw Error(where,
              fmt::format("the file ends where {}End was expected, for the block begun at {}",
                          name_of(block.kind), block.where.text()));
}

}  // namespace tessera
