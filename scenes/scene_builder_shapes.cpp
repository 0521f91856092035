/// SceneBuilder: shapes, object definitions and their instances.

#include "scenes/scene_builder.h"

namespace tessera {

namespace {

/// Bound what nested object instances can multiply into; a placed shape takes about 400 bytes.
constexpr size_t most_object_shapes = size_t(1) << 18;
constexpr size_t most_surfaces = size_t(1) << 22;

}  // namespace

void SceneBuilder::shape(ShapeCall call, const SourceLocation& where) {
  if (!inside(BlockKind::world) && !inside(BlockKind::object))
    throw Error(where, "found a shape outside of any world; expected WorldBegin before it");
  KeyedShape shape = build_shape(std::move(call), attributes_.basis(), where, diagnostics_);
  if (motion_)
    motion_->add_shape(std::move(shape), where);
  else
    place(std::move(shape), where);
}

void SceneBuilder::place(KeyedShape shape, const SourceLocation& where) {
  if (object_) {
    if (object_->size() >= most_object_shapes)
      throw Error(where, fmt::format("an object of more than {} shapes", most_object_shapes));
    if (!object_attributes_) object_attributes_ = std::make_shared<AttributeState>(attributes_);
    object_->push_back({std::make_shared<const KeyedShape>(std::move(shape)), outer_from_current_,
                        object_attributes_});
    return;
  }
  const ShutterInterval shutter = options_.shutter();
  add_surface(std::make_shared<const Geometry>(in_shutter(std::move(shape), shutter)),
              attributes_.freeze(outer_from_current_, shutter), outer_from_current_,
              attributes_.inside(), where);
}

void SceneBuilder::add_surface(std::shared_ptr<const Geometry> geometry,
                               std::shared_ptr<const Attributes> attributes,
                               const KeyedTransform& world_from_object, bool inside_out,
                               const SourceLocation& where) {
  if (scene_->surfaces.size() >= most_surfaces)
    throw Error(where, fmt::format("a world of more than {} surfaces", most_surfaces));
  Surface surface;
  surface.id = int(scene_->surfaces.size());
  surface.geometry = std::move(geometry);
  surface.attributes = std::move(attributes);
  surface.world_from_object = world_from_object.in_shutter(options_.shutter());
  surface.flip_normal = inside_out != (world_from_object.handedness() < 0);
  scene_->surfaces.push_back(std::move(surface));
}

void SceneBuilder::instance(const std::string& object_handle, const SourceLocation& where) {
  if (motion_) throw Error(where, "found ObjectInstance in a motion block; move it by a transform");
  const auto found = definitions_.objects.find(object_handle);
  if (found == definitions_.objects.end())
    throw Error(where, fmt::format("no object has the handle \"{}\"", object_handle));
  if (object_) return instance_in_object(*found->second, where);
  if (!inside(BlockKind::world))
    throw Error(where, "found ObjectInstance outside of any world; expected WorldBegin before it");
  const ShutterInterval shutter = options_.shutter();
  std::shared_ptr<AttributeState> source;
  AttributeState merged;
  for (const ObjectShape& part : *found->second) {
    // Shapes that share their attributes in the definition share them in the instance.
    if (part.attributes != source) {
      source = part.attributes;
      merged = attributes_.overridden_by(*source, outer_from_current_);
    }
    std::shared_ptr<const Geometry>& geometry = instanced_[part.shape];
    if (!geometry) geometry = std::make_shared<const Geometry>(in_shutter(*part.shape, shutter));
    const KeyedTransform world_from_object = outer_from_current_ * part.definition_from_object;
    add_surface(geometry, merged.freeze(world_from_object, shutter), world_from_object,
                merged.inside(), where);
  }
}

void SceneBuilder::instance_in_object(const ObjectDefinition& inner, const SourceLocation& where) {
  std::shared_ptr<AttributeState> source, merged;
  for (const ObjectShape& part : inner) {
    if (object_->size() >= most_object_shapes)
      throw Error(where, fmt::format("an object of more than {} shapes", most_object_shapes));
    if (part.attributes != source) {
      source = part.attributes;
      merged =
          std::make_shared<AttributeState>(attributes_.overridden_by(*source, outer_from_current_));
    }
    object_->push_back({part.shape, outer_from_current_ * part.definition_from_object, merged});
  }
}

}  // namespace tessera
