#pragma once
/// Turns the calls of a scene format into Scenes, one per world block.

#include <memory>
#include <optional>

#include "scenes/attribute_state.h"
#include "scenes/motion_block.h"
#include "scenes/option_state.h"
#include "scenes/scene_sink.h"

namespace tessera {

/// Keeps the graphics state and delivers each finished world to a SceneSink. Every check that does
/// not belong to a file format is made here, as the calls arrive.
class SceneBuilder : public SceneCalls {
 public:
  /// `file` becomes Scene::file. The sink and the diagnostics must outlive the builder.
  SceneBuilder(SceneSink& sink, Diagnostics& diagnostics, std::string file);

  void begin(const BlockCall& block, const SourceLocation& where) override;
  void end(BlockKind kind, const SourceLocation& where) override;
  void option(const OptionCall& call, const SourceLocation& where) override;
  void attribute(const AttributeCall& call, const SourceLocation& where) override;
  void transform(const TransformCall& call, const SourceLocation& where) override;
  void light(const LightCall& call, const SourceLocation& where) override;
  void shape(ShapeCall call, const SourceLocation& where) override;
  void instance(const std::string& object_handle, const SourceLocation& where) override;
  void finish(const SourceLocation& where) override;
  bool wants_more() const override { return wants_more_; }

 private:
  /// A light with its space still in scene time.
  struct KeyedLight {
    LightCall call;
    KeyedTransform outer_from_light;
    SourceLocation where;
    std::string shadow;  ///< as in Light
  };
  /// A shape of an object definition; its spaces are relative to the definition.
  struct ObjectShape {
    std::shared_ptr<const KeyedShape> shape;
    KeyedTransform definition_from_object;
    std::shared_ptr<AttributeState> attributes;
  };
  using ObjectDefinition = std::vector<ObjectShape>;

  /// What lasts to the end of the enclosing frame or world.
  struct Definitions {
    std::vector<KeyedLight> lights;
    std::map<std::string, int> light_handles;
    std::map<std::string, KeyedTransform> named_spaces;
    std::map<std::string, std::shared_ptr<const ObjectDefinition>> objects;
  };
  /// An open block with what its end restores.
  struct OpenBlock {
    BlockKind kind;
    SourceLocation where;
    KeyedTransform transform;
    std::optional<AttributeState> attributes;
    std::unique_ptr<OptionState> options;
    std::unique_ptr<Definitions> definitions;
  };

  void check_block_allowed(const BlockCall& block, const SourceLocation& where) const;
  void begin_world();
  void begin_object(const std::string& handle);
  void end_world();
  void end_object();
  void end_motion(const SourceLocation& where);
  std::unique_ptr<Scene> finished_scene();

  bool inside(BlockKind kind) const;
  int current_handedness() const;
  void concat(const glm::dmat4& matrix, const SourceLocation& where);
  /// The matrix with its last row normalised, or nothing, with a warning, if it is projective.
  std::optional<glm::dmat4> affine_part(const glm::dmat4& matrix, const SourceLocation& where);
  void set(const glm::dmat4& matrix, const SourceLocation& where);
  void perspective(double fov_degrees, const SourceLocation& where);
  void use_space(const std::string& name, const SourceLocation& where);
  /// Whether this call is the first of its motion block, or outside of one; warns when it is not.
  bool takes_value(const char* what, const SourceLocation& where);
  void place(KeyedShape shape, const SourceLocation& where);
  void instance_in_object(const ObjectDefinition& inner, const SourceLocation& where);
  void add_surface(std::shared_ptr<const Geometry> geometry,
                   std::shared_ptr<const Attributes> attributes,
                   const KeyedTransform& world_from_object, bool inside_out,
                   const SourceLocation& where);

  SceneSink& sink_;
  Diagnostics& diagnostics_;
  std::string file_;
  bool wants_more_ = true;

  OptionState options_;
  AttributeState attributes_;
  KeyedTransform outer_from_current_;
  Definitions definitions_;
  std::vector<OpenBlock> blocks_;
  int frame_number_ = 0;

  KeyedTransform camera_from_world_;   ///< inside a world
  std::unique_ptr<Scene> scene_;       ///< inside a world
  std::optional<MotionBlock> motion_;  ///< inside a motion block
  bool motion_value_taken_ = false;
  std::string object_handle_;               ///< inside an object definition
  std::optional<ObjectDefinition> object_;  ///< inside an object definition
  /// The attributes of its last shape, while nothing has changed since.
  std::shared_ptr<AttributeState> object_attributes_;
  /// Geometry of object shapes in shutter time, shared by their instances in this world.
  std::map<std::shared_ptr<const KeyedShape>, std::shared_ptr<const Geometry>> instanced_;
};

}  // namespace tessera
