#include "scenes/rib/arguments.h"

#include <cmath>
#include <limits>

namespace tessera {

RibValue& RibArguments::take(const char* expected) {
  if (left() == 0) fail("expected {}, found no further argument", expected);
  return request_.values[next_++];
}

double RibArguments::number() {
  const RibValue& value = take("a number");
  if (value.numbers.size() != 1) fail("expected a number, found {}", describe(value));
  return value.numbers[0];
}

int RibArguments::to_integer(double value) const {
  constexpr double least = std::numeric_limits<int>::min(), most = std::numeric_limits<int>::max();
  if (!(value >= least && value <= most) || value != std::floor(value))
    fail("expected an integer, found {}", value);
  return int(value);
}

float RibArguments::to_float(double value) const {
  if (!(std::abs(value) <= double(std::numeric_limits<float>::max())))
    fail("expected a number within the range of float, found {}", value);
  return float(value);
}

int RibArguments::integer() { return to_integer(number()); }

std::string RibArguments::string() {
  RibValue& value = take("a string");
  if (value.strings.size() != 1) fail("expected a string, found {}", describe(value));
  return std::move(value.strings[0]);
}

std::string RibArguments::handle() {
  const RibValue* value = peek();
  if (value && value->strings.size() == 1) return string();
  return fmt::format("{}", integer());
}

std::vector<double> RibArguments::numbers(size_t count) {
  std::vector<double> result;
  while (result.size() < count) {
    if (left() == 0) fail("expected {} numbers, found {}", count, result.size());
    const RibValue& value = take("a number");
    if (!value.strings.empty())
      fail("expected {} numbers, found {} after {} of them", count, describe(value), result.size());
    result.insert(result.end(), value.numbers.begin(), value.numbers.end());
  }
  if (result.size() != count) fail("expected {} numbers, found {}", count, result.size());
  return result;
}

std::vector<double> RibArguments::number_array() {
  RibValue& value = take("an array of numbers");
  if (!value.strings.empty()) fail("expected an array of numbers, found {}", describe(value));
  return std::move(value.numbers);
}

std::vector<int> RibArguments::integer_array() {
  const std::vector<double> values = number_array();
  std::vector<int> result;
  result.reserve(values.size());
  for (double value : values) result.push_back(to_integer(value));
  return result;
}

std::vector<std::string> RibArguments::string_array() {
  RibValue& value = take("an array of strings");
  if (!value.numbers.empty()) fail("expected an array of strings, found {}", describe(value));
  return std::move(value.strings);
}

glm::vec3 RibArguments::color() {
  const std::vector<double> c = numbers(3);
  return {to_float(c[0]), to_float(c[1]), to_float(c[2])};
}

glm::dmat4 RibArguments::matrix() {
  const std::vector<double> m = numbers(16);
  // A row-major matrix for row vectors has the memory layout of a column-major one for columns.
  glm::dmat4 result;
  for (int i = 0; i < 16; ++i) result[i / 4][i % 4] = m[size_t(i)];
  return result;
}

bool RibArguments::next_is_numbers() const { return peek() && peek()->strings.empty(); }

bool RibArguments::next_is_string_array() const {
  return peek() && peek()->kind == RibValue::Kind::array && peek()->numbers.empty();
}

Parameter RibArguments::parameter(const std::string& name, const Declaration& declaration) {
  Parameter result;
  result.name = name;
  result.storage = declaration.storage;
  result.type = declaration.type;
  result.array_size = declaration.array_size;
  RibValue& value = take("a value");
  size_t found = 0;
  if (declaration.type == ValueType::string) {
    if (!value.numbers.empty()) fail("\"{}\": expected strings, found {}", name, describe(value));
    result.strings = std::move(value.strings);
    found = result.strings.size();
  } else {
    if (!value.strings.empty()) fail("\"{}\": expected numbers, found {}", name, describe(value));
    result.numbers.reserve(value.numbers.size());
    for (double number : value.numbers) result.numbers.push_back(to_float(number));
    found = result.numbers.size();
  }
  const size_t each = size_t(result.floats_per_value());
  if (found == 0 || found % each != 0)
    fail("\"{}\": expected {} of {}, found {}", name, each == 1 ? "one or more" : "a multiple",
         each, found);
  if (declaration.type == ValueType::integer)
    for (double number : value.numbers) to_integer(number);
  return result;
}

std::vector<Parameter> RibArguments::parameters(const Declarations& declarations,
                                                Diagnostics& diagnostics) {
  std::vector<Parameter> result;
  while (left() > 0) {
    if (peek()->strings.size() != 1)
      fail("expected the name of a parameter, found {}", describe(*peek()));
    const std::string token = string();
    if (left() == 0) fail("expected a value for the parameter \"{}\", found none", token);
    const auto [name, declaration] = declarations.resolve(token, where());
    if (!declaration) {
      diagnostics.warn_once(
          "parameter:" + name, where(),
          fmt::format("{}: parameter \"{:.60}\" has not been declared: skipped", request(), name));
      ++next_;
      continue;
    }
    Parameter read = parameter(name, *declaration);
    std::erase_if(result, [&](const Parameter& p) { return p.name == read.name; });
    result.push_back(std::move(read));
  }
  return result;
}

void RibArguments::finish() const {
  if (left() > 0) fail("expected no further argument, found {}", describe(*peek()));
}

}  // namespace tessera
