#include "shade/shader.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "shade/bindings.h"
#include "shade/mathematics.h"
#include "shade/textures.h"

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
  for (int i = 0; i < count(); ++i) {
    const glm::vec3 n = points_.N[i];
    facing.set(i, glm::dot(n, points_.I[i]) > 0.0f ? -n : n);
  }
  return facing;
}

Illumination ShaderContext::gather(const Vec3Array& N) const {
  Illumination light;
  gather_light(services_.lights, points_, N, nullptr, Shadows::cast, light, *services_.counters);
  return light;
}

Illumination ShaderContext::gather(const Vec3Array& N, const ScalarInput& roughness) const {
  Illumination light;
  gather_light(services_.lights, points_, N, &roughness, Shadows::cast, light, *services_.counters);
  return light;
}

Illumination ShaderContext::gather_together(const Vec3Array& N,
                                            const ScalarInput* roughness) const {
  std::vector<const BoundLight*> lights;
  std::ranges::copy_if(services_.lights, std::back_inserter(lights),
                       [](const BoundLight* light) { return !light->term; });
  Illumination light;
  gather_light(lights, points_, N, roughness, Shadows::cast, light, *services_.counters);
  return light;
}

Illumination ShaderContext::gather_alone(const BoundLight& light, const Vec3Array& N,
                                         const ScalarInput* roughness) const {
  const BoundLight* const lights[] = {&light};
  Illumination alone;
  gather_light(lights, points_, N, roughness, Shadows::left_out, alone, *services_.counters);
  return alone;
}

Vec3Array ShaderContext::texture(const std::string& file) const {
  services_.counters->texture_lookups += uint64_t(count());
  const size_t n = size_t(count());
  const StFootprint& d = points_.st_footprint;
  const std::vector<float> zeros(d.dsdx ? 0 : n, 0.0f);
  const auto change = [&](const float* given) {
    return given ? std::span(given, n) : std::span<const float>(zeros);
  };
  const TexturePoints points{{points_.s, n}, {points_.t, n}, change(d.dsdx),
                             change(d.dtdx), change(d.dsdy), change(d.dtdy)};
  return services_.textures->color({.file = file}, points, shader_.where);
}

Vec3Array ShaderContext::environment(const std::string& file, const Vec3Array& direction_camera,
                                     const ScalarInput& blur) const {
  services_.counters->texture_lookups += uint64_t(count());
  const size_t n = size_t(count());
  std::vector<float> s(n), t(n), ds(n), dt(n);
  const std::vector<float> zeros(n, 0.0f);
  const glm::dmat3 world_from_camera(shader_.world_from_camera);
  for (size_t i = 0; i < n; ++i) {
    const glm::dvec3 from_eye(direction_camera[int(i)]);
    const glm::vec3 d = unit_or_zero(glm::vec3(world_from_camera * from_eye));
    s[i] = 0.5f - std::atan2(d.y, d.x) / (2.0f * pi);
    t[i] = std::acos(std::clamp(d.z, -1.0f, 1.0f)) / pi;
    // A circle of directions spans more longitude near the poles.
    const float sine = std::sqrt(std::max(0.0f, 1.0f - d.z * d.z));
    ds[i] = std::min(1.0f, blur[int(i)] / (2.0f * pi) / std::max(sine, 1e-3f));
    dt[i] = blur[int(i)] / pi;
  }
  const TextureRequest request{.file = file, .t_wrap = TextureWrap::clamp};
  return services_.textures->color(request, {s, t, ds, zeros, zeros, dt}, shader_.where);
}

glm::vec3 ShaderContext::shader_vector(const glm::vec3& vector_camera) const {
  return transformed(shader_.spaces.shader_from_camera, ValueType::vector, vector_camera);
}

PatternPoints ShaderContext::pattern_points() const {
  PatternPoints pattern{Vec3Array(count()), AlignedVector<float>(padded(size_t(count())))};
  const PrimvarView* reference = points_.find_primvar("Pref");
  const bool use_reference = reference && reference->components == 3;
  const Vec3Input source =
      use_reference ? Vec3Input::varying(reference->values, reference->stride) : points_.P;
  const glm::dmat4& shader_from_camera = shader_.spaces.shader_from_camera;
  const glm::dmat4 shader_from_source =
      use_reference ? shader_from_camera * points_.camera_from_object : shader_from_camera;
  for (int i = 0; i < count(); ++i) {
    pattern.P.set(i, transformed(shader_from_source, ValueType::point, source[i]));
  }
  if (!points_.dPdx.x) return pattern;
  for (int i = 0; i < count(); ++i) {
    pattern.footprint[size_t(i)] = std::max(glm::length(shader_vector(points_.dPdx[i])),
                                            glm::length(shader_vector(points_.dPdy[i])));
  }
  return pattern;
}

}  // namespace tessera
