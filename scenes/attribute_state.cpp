#include "scenes/attribute_state.h"

#include <algorithm>

#include "scenes/patch_basis.h"

namespace tessera {

enum AttributeState::Field : uint32_t {
  field_color = 1u << 0,
  field_opacity = 1u << 1,
  field_surface = 1u << 2,
  field_displacement = 1u << 3,
  field_lights = 1u << 4,
  field_area_light = 1u << 5,
  field_shading_rate = 1u << 6,
  field_interpolation = 1u << 7,
  field_sides = 1u << 8,
  field_orientation = 1u << 9,
  field_matte = 1u << 10,
  field_texture_coordinates = 1u << 11,
  field_motion_factor = 1u << 12,
  field_focus_factor = 1u << 13,
  field_basis = 1u << 14,
  field_name = 1u << 15,
  field_bound = 1u << 16,
  field_user = 1u << 17,
};

/// Applies one attribute call. Overloaded by kind of call.
class ApplyAttribute {
 public:
  ApplyAttribute(AttributeState& state, const AttributeContext& context)
      : state_(state), values_(state.values_), context_(context) {}

  void operator()(const attribute_call::Color& call) const {
    values_.color = call.rgb;
    state_.touch(AttributeState::field_color);
  }
  void operator()(const attribute_call::Opacity& call) const {
    values_.opacity = call.rgb;
    state_.touch(AttributeState::field_opacity);
  }
  void operator()(const attribute_call::Shader& call) const;
  void operator()(const attribute_call::Illuminate& call) const;
  void operator()(const attribute_call::ShadingRate& call) const {
    expect(call.area > 0, fmt::format("expected a positive shading rate, found {}", call.area));
    values_.shading_rate = float(call.area);
    state_.touch(AttributeState::field_shading_rate);
  }
  void operator()(const attribute_call::ShadingInterpolation& call) const {
    values_.smooth_shading = call.smooth;
    state_.touch(AttributeState::field_interpolation);
  }
  void operator()(const attribute_call::Sides& call) const {
    expect(call.count == 1 || call.count == 2,
           fmt::format("expected 1 or 2 sides, found {}", call.count));
    values_.two_sided = call.count == 2;
    state_.touch(AttributeState::field_sides);
  }
  void operator()(const attribute_call::Orientation& call) const;
  void operator()(const attribute_call::ReverseOrientation&) const {
    state_.inside_ = !state_.inside_;
    state_.touch(AttributeState::field_orientation);
  }
  void operator()(const attribute_call::Matte& call) const {
    values_.matte = call.on;
    state_.touch(AttributeState::field_matte);
  }
  void operator()(const attribute_call::TextureCoordinates& call) const {
    values_.texture_coordinates = call.st;
    state_.touch(AttributeState::field_texture_coordinates);
  }
  void operator()(const attribute_call::GeometricApproximation& call) const;
  void operator()(const attribute_call::Basis& call) const {
    state_.basis_ = call;
    state_.touch(AttributeState::field_basis);
  }
  void operator()(const attribute_call::User& call) const;

 private:
  void expect(bool condition, const std::string& message) const {
    if (!condition) throw Error(context_.where, message);
  }
  void displacement_bound(const attribute_call::User& call) const;
  void check_dicing_rate(const Parameter& rate) const;

  AttributeState& state_;
  Attributes& values_;
  const AttributeContext& context_;
};

void ApplyAttribute::operator()(const attribute_call::Shader& call) const {
  const bool surface = call.slot == attribute_call::Shader::Slot::surface;
  std::optional<ShaderCall>& shader = surface ? values_.surface : values_.displacement;
  shader.reset();
  if (!call.name.empty()) shader = ShaderCall{call.name, call.parameters, {}, context_.where};
  (surface ? state_.outer_from_surface_ : state_.outer_from_displacement_) =
      context_.outer_from_current;
  state_.touch(surface ? AttributeState::field_surface : AttributeState::field_displacement);
}

void ApplyAttribute::operator()(const attribute_call::Illuminate& call) const {
  const auto found = context_.light_handles.find(call.handle);
  if (found == context_.light_handles.end()) {
    context_.diagnostics.warn_once(
        "illuminate", context_.where,
        fmt::format("no light has the handle \"{}\": Illuminate left out", call.handle));
    return;
  }
  state_.switch_light(found->second, call.on);
}

void ApplyAttribute::operator()(const attribute_call::Orientation& call) const {
  using Kind = attribute_call::Orientation::Kind;
  const bool left_handed = context_.current_handedness > 0;
  switch (call.kind) {
    case Kind::outside:
      state_.inside_ = false;
      break;
    case Kind::inside:
      state_.inside_ = true;
      break;
    case Kind::left_handed:
      state_.inside_ = !left_handed;
      break;
    case Kind::right_handed:
      state_.inside_ = left_handed;
      break;
  }
  state_.touch(AttributeState::field_orientation);
}

void ApplyAttribute::operator()(const attribute_call::GeometricApproximation& call) const {
  const bool motion = call.kind == "motionfactor";
  if (!motion && call.kind != "focusfactor") return;
  expect(call.value >= 0,
         fmt::format("\"{}\": expected at least 0, found {}", call.kind, call.value));
  (motion ? values_.motion_factor : values_.focus_factor) = float(call.value);
  state_.touch(motion ? AttributeState::field_motion_factor : AttributeState::field_focus_factor);
}

void ApplyAttribute::displacement_bound(const attribute_call::User& call) const {
  const Parameter* sphere = find_parameter(call.parameters, "sphere");
  if (!sphere || sphere->numbers.empty()) return;
  const Parameter* space = find_parameter(call.parameters, "coordinatesystem");
  const std::string name = space && !space->strings.empty() ? space->strings[0] : "object";
  AttributeState::DisplacementBound bound;
  bound.radius = double(sphere->numbers[0]);
  expect(bound.radius >= 0,
         fmt::format("\"sphere\": expected a bound of at least 0, found {}", bound.radius));
  bound.in_object_space = name == "object";
  const auto named = context_.named_spaces.find(name);
  if (named != context_.named_spaces.end())
    bound.outer_from_bound = named->second;
  else if (name == "shader" && values_.displacement)
    bound.outer_from_bound = state_.outer_from_displacement_;
  else if (name != "world")  // "current", "shader" without a shader, and names nobody defined
    bound.outer_from_bound = context_.outer_from_current;
  state_.bound_ = bound;
  state_.touch(AttributeState::field_bound);
}

void ApplyAttribute::check_dicing_rate(const Parameter& rate) const {
  expect(rate.numbers.size() == 1, "\"dice\" \"rate\": expected one number of pixels^2");
  expect(rate.numbers[0] > 0,
         fmt::format("expected a positive dicing rate, found {}", rate.numbers[0]));
}

void ApplyAttribute::operator()(const attribute_call::User& call) const {
  if (call.category == "displacementbound") return displacement_bound(call);
  for (const Parameter& parameter : call.parameters) {
    if (call.category == "identifier" && parameter.name == "name" && !parameter.strings.empty()) {
      values_.name = parameter.strings.front();
      state_.touch(AttributeState::field_name);
    } else {
      if (call.category == "dice" && parameter.name == "rate") check_dicing_rate(parameter);
      values_.user[call.category + ":" + parameter.name] = parameter;
      state_.touch(AttributeState::field_user);
    }
  }
}

AttributeState::AttributeState() {
  const NamedBasis bezier = *named_basis("bezier");
  basis_ = {bezier.matrix, bezier.matrix, bezier.step, bezier.step};
}

void AttributeState::touch(uint32_t field) {
  explicit_ |= field;
  frozen_.reset();
}

void AttributeState::apply(const AttributeCall& call, const AttributeContext& context) {
  std::visit(ApplyAttribute(*this, context), call);
}

void AttributeState::switch_light(int light, bool on) {
  std::vector<int>& lights = values_.lights;
  const auto place = std::lower_bound(lights.begin(), lights.end(), light);
  const bool found = place != lights.end() && *place == light;
  if (on && !found) lights.insert(place, light);
  if (!on && found) lights.erase(place);
  touch(field_lights);
}

void AttributeState::set_area_light(std::optional<int> light) {
  values_.area_light = light;
  touch(field_area_light);
}

std::string AttributeState::light_shadow() const {
  for (const char* name : {"light:shadow", "light:shadows"}) {
    const auto given = values_.user.find(name);
    if (given != values_.user.end() && !given->second.strings.empty()) {
      return given->second.strings.front();
    }
  }
  return "";
}

void AttributeState::rebase(const KeyedTransform& new_from_outer) {
  outer_from_surface_ = new_from_outer * outer_from_surface_;
  outer_from_displacement_ = new_from_outer * outer_from_displacement_;
  bound_.outer_from_bound = new_from_outer * bound_.outer_from_bound;
  frozen_.reset();
}

void AttributeState::begin_object() {
  explicit_ = 0;
  values_.user.clear();
  frozen_.reset();
}

AttributeState AttributeState::overridden_by(const AttributeState& object,
                                             const KeyedTransform& world_from_definition) const {
  AttributeState result = *this;
  AttributeState moved = object;
  moved.rebase(world_from_definition);
  const auto take = [&](uint32_t field, auto member) {
    if (object.explicit_ & field) result.*member = moved.*member;
  };
  const auto take_value = [&](uint32_t field, auto member) {
    if (object.explicit_ & field) result.values_.*member = moved.values_.*member;
  };
  take_value(field_color, &Attributes::color);
  take_value(field_opacity, &Attributes::opacity);
  take_value(field_surface, &Attributes::surface);
  take(field_surface, &AttributeState::outer_from_surface_);
  take_value(field_displacement, &Attributes::displacement);
  take(field_displacement, &AttributeState::outer_from_displacement_);
  take_value(field_lights, &Attributes::lights);
  take_value(field_area_light, &Attributes::area_light);
  take_value(field_shading_rate, &Attributes::shading_rate);
  take_value(field_interpolation, &Attributes::smooth_shading);
  take_value(field_sides, &Attributes::two_sided);
  take_value(field_matte, &Attributes::matte);
  take_value(field_texture_coordinates, &Attributes::texture_coordinates);
  take_value(field_motion_factor, &Attributes::motion_factor);
  take_value(field_focus_factor, &Attributes::focus_factor);
  take_value(field_name, &Attributes::name);
  take(field_orientation, &AttributeState::inside_);
  take(field_basis, &AttributeState::basis_);
  take(field_bound, &AttributeState::bound_);
  for (const auto& [key, parameter] : object.values_.user) result.values_.user[key] = parameter;
  result.explicit_ |= object.explicit_;
  result.frozen_.reset();
  return result;
}

double AttributeState::bound_in_world(const KeyedTransform& world_from_object) const {
  if (bound_.radius == 0.0) return 0.0;
  double stretch = 0.0;
  const KeyedTransform& space =
      bound_.in_object_space ? world_from_object : bound_.outer_from_bound;
  for (const glm::dmat4& matrix : space.matrices())
    stretch = std::max(stretch, largest_stretch(matrix));
  return bound_.radius * stretch;
}

std::shared_ptr<const Attributes> AttributeState::freeze(const KeyedTransform& world_from_object,
                                                         ShutterInterval shutter) {
  const float bound = float(bound_in_world(world_from_object));
  if (frozen_ && frozen_->displacement_bound == bound) return frozen_;
  auto attributes = std::make_shared<Attributes>(values_);
  attributes->displacement_bound = bound;
  if (attributes->surface)
    attributes->surface->world_from_shader = outer_from_surface_.in_shutter(shutter);
  if (attributes->displacement)
    attributes->displacement->world_from_shader = outer_from_displacement_.in_shutter(shutter);
  frozen_ = std::move(attributes);
  return frozen_;
}

}  // namespace tessera
