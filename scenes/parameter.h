#pragma once
/// Named values attached to shaders and geometry.

#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace tessera {

enum class StorageClass { constant, uniform, varying, vertex, facevarying };
enum class ValueType { integer, scalar, point, vector, normal, color, hpoint, matrix, string };

/// Floats (or strings) one value of this type holds: scalar 1, color 3, hpoint 4, matrix 16, ...
int component_count(ValueType type);
const char* name_of(StorageClass storage);
const char* name_of(ValueType type);

/// A parameter of a shader, light, option or display, or a primitive variable of a surface.
/// `numbers` holds value_count() values one after the other, each array_size * component_count()
/// floats; integers are stored as floats. Strings are in `strings`.
struct Parameter {
  std::string name;
  StorageClass storage = StorageClass::uniform;
  ValueType type = ValueType::scalar;
  int array_size = 1;
  std::vector<float> numbers;
  std::vector<std::string> strings;

  int floats_per_value() const { return array_size * component_count(type); }
  size_t value_count() const {
    const size_t held = type == ValueType::string ? strings.size() : numbers.size();
    return held / size_t(floats_per_value());
  }
};

/// The parameter called `name`, or null.
const Parameter* find_parameter(const std::vector<Parameter>& parameters, std::string_view name);

}  // namespace tessera
