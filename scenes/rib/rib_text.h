#pragma once
/// Pieces of ASCII RIB.

#include <string>
#include <vector>

#include <fmt/ranges.h>
#include <glm/glm.hpp>

#include "scenes/parameter.h"

namespace tessera::rib_text {

/// In quotes, with escapes for what cannot stand between them.
std::string quoted(const std::string& text);
/// "[1 2 3]", or "[]"; each number with the digits that give it back exactly.
template <class Range>
std::string array(const Range& values) {
  return fmt::format("[{}]", fmt::join(values, " "));
}
std::string string_array(const std::vector<std::string>& values);
/// 16 numbers in RIB's row-vector convention.
std::string matrix(const glm::dmat4& matrix);
/// ' "class type[n] name" [values]' for each parameter.
std::string parameters(const std::vector<Parameter>& parameters);

}  // namespace tessera::rib_text
