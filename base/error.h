#pragma once
/// The one exception type of the project, and where in a scene file something was said.

#include <stdexcept>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace tessera {

/// A place in a scene file. `line` counts from 1; 0 means "the file as a whole".
struct SourceLocation {
  std::string file;
  int line = 0;

  std::string text() const {
    if (file.empty()) return "";
    return line > 0 ? fmt::format("{}:{}", file, line) : file;
  }
};

/// Bad input or a failed operation. what() reads "file:line: message" where a place is known; the
/// message says what was found and what was expected.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& message) : std::runtime_error(message) {}
  Error(const SourceLocation& where, const std::string& message)
      : std::runtime_error(where.file.empty() ? message : where.text() + ": " + message) {}
};

}  // namespace tessera
