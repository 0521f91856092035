#include "scenes/rib/rib_text.h"

#include <span>

#include <glm/gtc/type_ptr.hpp>

namespace tessera::rib_text {

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      result += std::string("\\") + c;
    else if (c >= ' ' && c != 127)
      result += c;
    else
      result += fmt::format("\\{:03o}", int((unsigned char)c));
  }
  return result + "\"";
}

std::string string_array(const std::vector<std::string>& values) {
  std::vector<std::string> texts;
  for (const std::string& value : values) texts.push_back(quoted(value));
  return array(texts);
}

std::string matrix(const glm::dmat4& matrix) {
  // Columns of the one convention are the rows of the other.
  return array(std::span(glm::value_ptr(matrix), 16));
}

std::string parameters(const std::vector<Parameter>& parameters) {
  std::string result;
  for (const Parameter& p : parameters) {
    const std::string size = p.array_size == 1 ? "" : fmt::format("[{}]", p.array_size);
    result += fmt::format(" \"{} {}{} {}\" {}", name_of(p.storage), name_of(p.type), size, p.name,
                          p.type == ValueType::string ? string_array(p.strings) : array(p.numbers));
  }
  return result;
}

}  // namespace tessera::rib_text
