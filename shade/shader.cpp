#include "shade/shader.h"

#include <algorithm>
#include <iterator>

#include "shade/bindings.h"
#include "shade/mathematics.h"

namespace tessera {

const char* name_of(ShaderKind kind) {
  return kind == ShaderKind::surface ? "surface" : "displacement";
}

const ShaderDefinition* find_shader(ShaderKind kind, std::string_view name) {
  for (const ShaderDefinition& definition : shader_registry()) {
    if (definition.kind != kind) continue;
    if (definition.name == name || std::ranges::count(definition.aliases, name) > 0) {
      return &definition;
    }
  }
  return nullptr;
}

ShaderContext::ShaderContext(const BoundShader& shader, const ShadingPoints& points,
                             const ShaderServices& services)
    : shader_(shader), points_(points), services_(services) {
  const auto declarations = shader.parameters.declarations();
  camera_values_.reserve(declarations.size());  // Value points into its elements
  for (size_t k = 0; k < declarations.size(); ++k) {
    const ValueType type = declarations[k].type;
    const PrimvarView* view =
        type == ValueType::string ? nullptr : points.find_primvar(declarations[k].name);
    if (!view || view->components != component_count(type)) {
      values_.push_back({shader.parameters.numbers(int(k)), 1, 0});
      continue;
    }
    values_.push_back({view->values, view->stride, 1});
    if (type != ValueType::point && type != ValueType::vector && type != ValueType::normal) {
      continue;
    }
    const Vec3Input given = Vec3Input::varying(view->values, view->stride);
    Vec3Array& converted = camera_values_.emplace_back(points.count);
    for (int i = 0; i < points.count; ++i) {
      converted.set(i, transformed(points.camera_from_object, type, given[i]));
    }
    values_.back() = {converted.component(0),
                      size_t(converted.component(1) - converted.component(0)), 1};
  }
}

ScalarInput ShaderContext::scalar(std::string_view name) const {
  const Value& value = values_[size_t(shader_.parameters.require(name, 1))];
  return {value.values, value.step};
}

Vec3Input ShaderContext::vec3(std::string_view name) const {
  const Value& value = values_[size_t(shader_.parameters.require(name, 3))];
  return {value.values, value.values + value.stride, value.values + 2 * value.stride, value.step};
}

const std::string& ShaderContext::string(std::string_view name) const {
  return shader_.parameters.string(name);
}

Vec3Array ShaderContext::facing_normals() const {
  Vec3Array facing(count());
  for (int i = 0; i < count(); ++i) facing.set(i, turned_against(points_.N[i], points_.I[i]));
  return facing;
}

Illumination ShaderContext::gather_together(const Vec3Array& N,
                                            const ScalarInput* roughness) const {
  std::vector<const BoundLight*> lights;
  std::ranges::copy_if(services_.lights, std::back_inserter(lights),
                       [](const BoundLight* light) { return !light->term; });
  return gather_from(lights, N, roughness, Shadows::cast);
}

Illumination ShaderContext::gather_alone(const BoundLight& light, const Vec3Array& N,
                                         const ScalarInput* roughness) const {
  const BoundLight* const lights[] = {&light};
  return gather_from(lights, N, roughness, Shadows::left_out);
}

Illumination ShaderContext::gather_from(std::span<const BoundLight* const> lights,
                                        const Vec3Array& N, const ScalarInput* roughness,
                                        Shadows shadows) const {
  Illumination light;
  const ScalarInput* wanted = services_.diffuse_only ? nullptr : roughness;
  gather_light(lights, points_, N, wanted, shadows, light, *services_.counters);
  if (roughness && !wanted) light.specular.reset(count());
  return light;
}

glm::vec3 ShaderContext::shader_vector(const glm::vec3& vector_camera) const {
  return transformed(shader_.spaces.shader_from_camera, ValueType::vector, vector_camera);
}

}  // namespace tessera
