#include "scenes/parameter.h"

#include <algorithm>

namespace tessera {

int component_count(ValueType type) {
  switch (type) {
    case ValueType::integer:
    case ValueType::scalar:
    case ValueType::string:
      return 1;
    case ValueType::point:
    case ValueType::vector:
    case ValueType::normal:
    case ValueType::color:
      return 3;
    case ValueType::hpoint:
      return 4;
    case ValueType::matrix:
      return 16;
  }
  return 1;
}

const char* name_of(StorageClass storage) {
  static constexpr const char* names[] = {"constant", "uniform", "varying", "vertex",
                                          "facevarying"};
  return names[int(storage)];
}

const char* name_of(ValueType type) {
  static constexpr const char* names[] = {"integer", "float",  "point",  "vector", "normal",
                                          "color",   "hpoint", "matrix", "string"};
  return names[int(type)];
}

const Parameter* find_parameter(const std::vector<Parameter>& parameters, std::string_view name) {
  const auto found = std::find_if(parameters.begin(), parameters.end(),
                                  [&](const Parameter& p) { return p.name == name; });
  return found == parameters.end() ? nullptr : &*found;
}

}  // namespace tessera
