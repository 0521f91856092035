#include "shade/parameters.h"

#include <algorithm>
#include <stdexcept>

namespace tessera {
namespace {

ParameterDeclaration vec3_parameter(std::string name, ValueType type, glm::vec3 value,
                                    std::string help) {
  return {std::move(name), type, {value.x, value.y, value.z}, "", std::move(help)};
}

/// Whether a value of type `given` can stand for a parameter of type `declared`.
bool fits(const Parameter& given, ValueType declared) {
  if (declared == ValueType::string) return given.type == declared && !given.strings.empty();
  return given.type != ValueType::string &&
         component_count(given.type) == component_count(declared) &&
         given.numbers.size() >= size_t(component_count(declared));
}

bool is_spatial(ValueType type) {
  return type == ValueType::point || type == ValueType::vector || type == ValueType::normal;
}

}  // namespace

ParameterDeclaration scalar_parameter(std::string name, float value, std::string help) {
  return {std::move(name), ValueType::scalar, {value}, "", std::move(help)};
}
ParameterDeclaration color_parameter(std::string name, glm::vec3 value, std::string help) {
  return vec3_parameter(std::move(name), ValueType::color, value, std::move(help));
}
ParameterDeclaration point_parameter(std::string name, glm::vec3 value, std::string help) {
  return vec3_parameter(std::move(name), ValueType::point, value, std::move(help));
}
ParameterDeclaration vector_parameter(std::string name, glm::vec3 value, std::string help) {
  return vec3_parameter(std::move(name), ValueType::vector, value, std::move(help));
}
ParameterDeclaration string_parameter(std::string name, std::string value, std::string help) {
  return {std::move(name), ValueType::string, {}, std::move(value), std::move(help)};
}

glm::vec3 transformed(const glm::dmat4& matrix, ValueType type, const glm::vec3& value) {
  const glm::dvec3 v(value);
  switch (type) {
    case ValueType::point:
      return glm::vec3(glm::dvec3(matrix * glm::dvec4(v, 1.0)));
    case ValueType::vector:
      return glm::vec3(glm::dmat3(matrix) * v);
    case ValueType::normal:
      return glm::vec3(glm::transpose(glm::inverse(glm::dmat3(matrix))) * v);
    default:
      return value;
  }
}

BoundParameters::BoundParameters(std::span<const ParameterDeclaration> declarations,
                                 const ShaderCall& call, const ShaderSpaces& spaces,
                                 const std::string& label, Diagnostics& diagnostics)
    : declarations_(declarations) {
  for (const Parameter& given : call.parameters) {
    const int index = find(given.name);
    if (index < 0) {
      diagnostics.warn_once(
          fmt::format("parameter {} of {}", given.name, label), call.where,
          fmt::format("{} has no parameter \"{}\"; it is ignored", label, given.name));
    } else if (!fits(given, declarations[size_t(index)].type)) {
      diagnostics.warn_once(
          fmt::format("type of parameter {} of {}", given.name, label), call.where,
          fmt::format("parameter \"{}\" of {} is a {}, expected a {}; the default is used",
                      given.name, label, name_of(given.type),
                      name_of(declarations[size_t(index)].type)));
    }
  }
  for (const ParameterDeclaration& declared : declarations) {
    const Parameter* given = find_parameter(call.parameters, declared.name);
    if (given && !fits(*given, declared.type)) given = nullptr;
    offsets_.push_back(numbers_.size());
    texts_.push_back(given && declared.type == ValueType::string ? given->strings.front()
                                                                 : declared.text);
    const std::vector<float>& source = given ? given->numbers : declared.numbers;
    if (declared.type == ValueType::string) continue;
    if (is_spatial(declared.type)) {
      const glm::vec3 value =
          transformed(spaces.camera_from_shader, declared.type, {source[0], source[1], source[2]});
      numbers_.insert(numbers_.end(), {value.x, value.y, value.z});
    } else {
      numbers_.insert(numbers_.end(), source.begin(),
                      source.begin() + component_count(declared.type));
    }
  }
}

int BoundParameters::find(std::string_view name) const {
  for (size_t i = 0; i < declarations_.size(); ++i) {
    if (declarations_[i].name == name) return int(i);
  }
  return -1;
}

int BoundParameters::require(std::string_view name, int components) const {
  const int index = find(name);
  if (index >= 0) {
    const ValueType type = declarations_[size_t(index)].type;
    const int held = type == ValueType::string ? 0 : component_count(type);
    if (held == components) return index;
  }
  throw std::logic_error(
      fmt::format("a shader asks for parameter \"{}\" that it does not declare "
                  "with that type",
                  name));
}

glm::vec3 BoundParameters::vec3(std::string_view name) const {
  const float* v = numbers(require(name, 3));
  return {v[0], v[1], v[2]};
}

}  // namespace tessera
