#pragma once
/// Requests with their arguments, not yet interpreted.

#include <string>
#include <vector>

#include "scenes/rib/lexer.h"

namespace tessera {

/// One argument: a number, a string, or an array of either.
struct RibValue {
  enum class Kind { number, string, array };
  Kind kind = Kind::number;
  std::vector<double> numbers;       ///< one for a number
  std::vector<std::string> strings;  ///< one for a string
};

/// "the number 3", "the string "abc"", "an array of 12 numbers".
std::string describe(const RibValue& value);

struct RibRequest {
  std::string name;
  std::vector<RibValue> values;
  SourceLocation where;
};

/// Splits a file into requests. A request ends where the next begins, so one that nobody knows can
/// be skipped whatever its arguments are.
class RequestParser {
 public:
  explicit RequestParser(ByteSource source) : lexer_(std::move(source)) { lexer_.next(token_); }

  /// Reads the next request; false at the end of the file. Throws Error for what is no request.
  bool next(RibRequest& request);
  SourceLocation where() const { return lexer_.where(); }

 private:
  void array(RibValue& value);
  void count_string();

  Lexer lexer_;
  Token token_;  ///< look-ahead
  size_t string_bytes_ = 0;
};

}  // namespace tessera
