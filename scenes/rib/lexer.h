#pragma once
/// Tokens of RIB, from its ASCII and binary encodings, which may be mixed in one file (RenderMan
/// Interface 3.2, appendix C.2).

#include <map>
#include <string>
#include <vector>

#include "base/error.h"
#include "scenes/rib/byte_source.h"

namespace tessera {

struct Token {
  enum class Kind { request, string, number, numbers, array_begin, array_end, end };
  Kind kind = Kind::end;
  std::string text;             ///< of a request or string
  double number = 0.0;          ///< finite
  std::vector<double> numbers;  ///< of an encoded float array; all finite
};

/// What was found, for messages: "the string "abc"", "the number 3", "the end of the file".
std::string describe(const Token& token);

class Lexer {
 public:
  explicit Lexer(ByteSource source) : source_(std::move(source)) {}

  /// Reads the next token into `token`, reusing its memory. Throws Error at the current line for
  /// anything that is not RIB: stray bytes, open strings, numbers that are not finite.
  void next(Token& token);
  /// The place of the last token read.
  SourceLocation where() const { return {source_.name(), line_}; }

 private:
  template <class... Args>
  [[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args) const {
    throw Error(where(), fmt::format(format, std::forward<Args>(args)...));
  }
  int get();
  void skip_space_and_comments();
  void quoted_string(std::string& text);
  int escaped_character();
  void ascii_number(Token& token);
  void request(Token& token);

  // lexer_binary.cpp
  bool encoded(Token& token);
  int encoded_byte();
  uint32_t encoded_unsigned(int bytes);
  double encoded_fixed_point(int bytes, int fraction_bytes);
  double encoded_float();
  double encoded_double();
  void encoded_string(uint32_t length, std::string& text);
  void string_token(std::string& text);
  void define_request();
  void define_string(int token_bytes);
  const std::string& defined_string(uint32_t code) const;

  ByteSource source_;
  int line_ = 1;
  std::string scratch_;
  std::map<uint32_t, std::string> defined_requests_, defined_strings_;
  size_t defined_bytes_ = 0;
};

/// Longest string accepted, bytes.
inline constexpr size_t longest_string = size_t(1) << 20;
/// Longest array accepted, values. Memory grows with the data read, never with a count alone.
inline constexpr size_t longest_array = size_t(1) << 27;

}  // namespace tessera
