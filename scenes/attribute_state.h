#pragma once
/// The attributes part of the graphics state.

#include <cstdint>
#include <memory>

#include "scenes/scene_calls.h"
#include "scenes/scene_time.h"

#include "base/diagnostics.h"

namespace tessera {

/// What an attribute call can depend on besides itself.
struct AttributeContext {
  const KeyedTransform& outer_from_current;
  /// Handedness of camera_from_current: +1 left-handed, as camera space is, -1 right-handed.
  int current_handedness;
  /// Index into the lights by handle.
  const std::map<std::string, int>& light_handles;
  const std::map<std::string, KeyedTransform>& named_spaces;
  const SourceLocation& where;
  Diagnostics& diagnostics;
};

/// Attributes in force; copied when an attribute block begins.
///
/// Orientation is kept relative to the current coordinate system. The Interface (3.2, section 4.2)
/// has the current orientation flip whenever the handedness of the current coordinate system flips,
/// so their relation is what a transform leaves alone: "lh" and "rh" become outside or inside on
/// the spot. Outside-out, the normal is cross(dP/du, dP/dv) taken in object space and carried along
/// as a normal, by the inverse transpose; since cross(M a, M b) = det(M) M^-T cross(a, b), the
/// cross product taken in world space is the negative of that where det(world_from_object) < 0.
/// Hence Surface::flip_normal = inside XOR det(world_from_object) < 0, whatever the camera does.
class AttributeState {
 public:
  AttributeState();

  void apply(const AttributeCall& call, const AttributeContext& context);
  void switch_light(int light, bool on);
  void set_area_light(std::optional<int> light);

  const attribute_call::Basis& basis() const { return basis_; }
  bool inside() const { return inside_; }
  const std::vector<int>& lights() const { return values_.lights; }
  std::optional<int> area_light() const { return values_.area_light; }
  /// As Light::shadow, for a light declared here.
  std::string light_shadow() const;

  /// Re-expresses all spaces in another outer space.
  void rebase(const KeyedTransform& new_from_outer);
  /// Starts an object definition: from here on, notes which attributes are set explicitly.
  void begin_object();
  /// These attributes overridden by those set explicitly in `object`, whose outer space is that of
  /// the definition.
  AttributeState overridden_by(const AttributeState& object,
                               const KeyedTransform& world_from_definition) const;

  /// The attributes in final form, for a shape placed by `world_from_object`. Shared between calls
  /// while nothing changes.
  std::shared_ptr<const Attributes> freeze(const KeyedTransform& world_from_object,
                                           ShutterInterval shutter);

 private:
  friend class ApplyAttribute;
  enum Field : uint32_t;

  struct DisplacementBound {
    double radius = 0.0;
    bool in_object_space = true;
    KeyedTransform outer_from_bound;  ///< used unless in_object_space
  };

  void touch(uint32_t field);
  double bound_in_world(const KeyedTransform& world_from_object) const;

  Attributes values_;  ///< world_from_shader and displacement_bound are set by freeze()
  KeyedTransform outer_from_surface_, outer_from_displacement_;
  DisplacementBound bound_;
  attribute_call::Basis basis_;
  bool inside_ = false;
  uint32_t explicit_ = 0;  ///< Fields set since begin_object()

  std::shared_ptr<const Attributes> frozen_;
};

}  // namespace tessera
