#pragma once
/// Typed shader parameters: what a shader declares, and what a scene gave it.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include "base/diagnostics.h"
#include "scenes/scene.h"

namespace tessera {

/// One parameter of a shader with its default. Points, vectors and normals are in the shader's own
/// space here and in the scene file; bound values are in camera space.
struct ParameterDeclaration {
  std::string name;
  ValueType type = ValueType::scalar;
  std::vector<float> numbers;  ///< component_count(type) of them
  std::string text;            ///< for strings
  std::string help;
};

ParameterDeclaration scalar_parameter(std::string name, float value, std::string help);
ParameterDeclaration color_parameter(std::string name, glm::vec3 value, std::string help);
ParameterDeclaration point_parameter(std::string name, glm::vec3 value, std::string help);
ParameterDeclaration vector_parameter(std::string name, glm::vec3 value, std::string help);
ParameterDeclaration string_parameter(std::string name, std::string value, std::string help);

/// Matrices a shader's parameters pass through, at shutter open.
struct ShaderSpaces {
  glm::dmat4 camera_from_shader{1.0}, shader_from_camera{1.0};
};

/// A three-vector of `type` (point, vector, normal; anything else is unchanged) through `matrix`.
glm::vec3 transformed(const glm::dmat4& matrix, ValueType type, const glm::vec3& value);

/// The values of every declared parameter of one shader call, in camera space.
class BoundParameters {
 public:
  /// Takes `call`'s values over the defaults. A parameter the shader does not have, or of a type
  /// that does not fit, is reported to `diagnostics` once, named with `label` ("surface shader
  /// \"plastic\""), and ignored. `declarations` must outlive the object.
  BoundParameters(std::span<const ParameterDeclaration> declarations, const ShaderCall& call,
                  const ShaderSpaces& spaces, const std::string& label, Diagnostics& diagnostics);

  std::span<const ParameterDeclaration> declarations() const { return declarations_; }
  /// Index of a declared parameter; -1 when there is none.
  int find(std::string_view name) const;
  const float* numbers(int index) const { return numbers_.data() + offsets_[size_t(index)]; }
  const std::string& text(int index) const { return texts_[size_t(index)]; }

  /// Values by name; throw std::logic_error when the shader declares no such parameter of the type.
  float scalar(std::string_view name) const { return *numbers(require(name, 1)); }
  glm::vec3 vec3(std::string_view name) const;
  const std::string& string(std::string_view name) const { return text(require(name, 0)); }
  /// Index of the parameter with that name and number of floats (0: a string), or throws.
  int require(std::string_view name, int components) const;

 private:
  std::span<const ParameterDeclaration> declarations_;
  std::vector<size_t> offsets_;  ///< [parameter] into numbers_
  std::vector<float> numbers_;
  std::vector<std::string> texts_;  ///< [parameter]
};

}  // namespace tessera
