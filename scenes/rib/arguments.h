#pragma once
/// The arguments of one request, read from left to right with checks.

#include <glm/glm.hpp>

#include "base/diagnostics.h"
#include "scenes/parameter.h"
#include "scenes/rib/declarations.h"
#include "scenes/rib/request_parser.h"

namespace tessera {

/// A cursor over the arguments of a request. Every reader takes the next argument or arguments and
/// throws Error, naming the request and its place, when they are not what is asked for. A number
/// may stand for an array of one and the other way round.
class RibArguments {
 public:
  /// The request must outlive the arguments; its arrays are moved out of it.
  explicit RibArguments(RibRequest& request) : request_(request) {}

  const std::string& request() const { return request_.name; }
  const SourceLocation& where() const { return request_.where; }
  size_t left() const { return request_.values.size() - next_; }

  double number();
  /// A whole number in the range of int.
  int integer();
  bool boolean() { return integer() != 0; }
  std::string string();
  /// A light or object handle: a string, or a number written out.
  std::string handle();

  /// `count` numbers, one by one or in arrays.
  std::vector<double> numbers(size_t count);
  /// A whole array.
  std::vector<double> number_array();
  std::vector<int> integer_array();
  std::vector<std::string> string_array();
  glm::vec3 color();
  /// 16 numbers; row-vector convention in the file, column-vector convention in the result.
  glm::dmat4 matrix();

  /// Whether the next argument holds numbers, or is an array of strings, or an empty array.
  bool next_is_numbers() const;
  bool next_is_string_array() const;
  const RibValue* peek() const { return left() > 0 ? &request_.values[next_] : nullptr; }

  /// All that is left, as token-value pairs. A parameter nobody declared is skipped with a warning.
  std::vector<Parameter> parameters(const Declarations& declarations, Diagnostics& diagnostics);
  /// Takes all that is left, unread.
  void discard() { next_ = request_.values.size(); }
  /// Throws unless every argument has been taken.
  void finish() const;

  template <class... Args>
  [[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args) const {
    throw Error(where(), request() + ": " + fmt::format(format, std::forward<Args>(args)...));
  }

 private:
  RibValue& take(const char* expected);
  float to_float(double value) const;
  int to_integer(double value) const;
  Parameter parameter(const std::string& name, const Declaration& declaration);

  RibRequest& request_;
  size_t next_ = 0;
};

}  // namespace tessera
