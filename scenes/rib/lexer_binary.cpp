/// Lexer: the binary encoding. A byte of 0200 (octal) or more starts an encoded token:
///   0200 + 4d + w   number, w + 1 bytes, two's complement, the last d of them after the point
///   0220 + n        string of n < 16 bytes
///   0240 + l        string; its length follows in l + 1 bytes
///   0244, 0245      32-bit and 64-bit IEEE number
///   0246            defined request; its code follows in one byte
///   0310 + l        array of 32-bit IEEE numbers; their count follows in l + 1 bytes
///   0314            definition of a request: a byte of code, then its name as a string
///   0315 + w        definition of a string: w + 1 bytes of code, then the string
///   0317 + w        defined string; its code follows in w + 1 bytes
/// Multi-byte values have their most significant byte first.

#include <bit>
#include <cmath>
#include <cstdint>

#include "scenes/rib/lexer.h"

namespace tessera {

namespace {

constexpr size_t most_defined_bytes = size_t(1) << 26;

}  // namespace

int Lexer::encoded_byte() {
  const int c = source_.get();
  if (c == -1) fail("the file ends inside an encoded token");
  return c;
}

uint32_t Lexer::encoded_unsigned(int bytes) {
  uint32_t value = 0;
  for (int i = 0; i < bytes; ++i) value = (value << 8) | uint32_t(encoded_byte());
  return value;
}

double Lexer::encoded_fixed_point(int bytes, int fraction_bytes) {
  const uint32_t raw = encoded_unsigned(bytes);
  const int shift = 32 - 8 * bytes;
  const int32_t value = int32_t(raw << shift) >> shift;  // extends the sign
  return std::ldexp(double(value), -8 * fraction_bytes);
}

double Lexer::encoded_float() {
  const float value = std::bit_cast<float>(encoded_unsigned(4));
  if (!std::isfinite(value)) fail("expected a finite number, found an encoded {}", value);
  return double(value);
}

double Lexer::encoded_double() {
  const uint64_t high = encoded_unsigned(4);
  const double value = std::bit_cast<double>((high << 32) | encoded_unsigned(4));
  if (!std::isfinite(value)) fail("expected a finite number, found an encoded {}", value);
  return value;
}

void Lexer::encoded_string(uint32_t length, std::string& text) {
  if (length > longest_string)
    fail("an encoded string of {} bytes; at most {} are accepted", length, longest_string);
  text.clear();
  for (uint32_t i = 0; i < length; ++i) text.push_back(char(encoded_byte()));
}

/// A string in any of its forms, as part of a definition.
void Lexer::string_token(std::string& text) {
  skip_space_and_comments();
  const int c = get();
  if (c == '"')
    quoted_string(text);
  else if (c >= 0220 && c < 0240)
    encoded_string(uint32_t(c - 0220), text);
  else if (c >= 0240 && c < 0244)
    encoded_string(encoded_unsigned(c - 0240 + 1), text);
  else
    fail("expected the string of a definition, found something else");
}

void Lexer::define_request() {
  const uint32_t code = encoded_unsigned(1);
  string_token(defined_requests_[code]);
}

void Lexer::define_string(int token_bytes) {
  const uint32_t code = encoded_unsigned(token_bytes);
  std::string& text = defined_strings_[code];
  defined_bytes_ -= text.size();
  string_token(text);
  defined_bytes_ += text.size();
  if (defined_bytes_ > most_defined_bytes)
    fail("more than {} bytes of defined strings", most_defined_bytes);
}

const std::string& Lexer::defined_string(uint32_t code) const {
  const auto found = defined_strings_.find(code);
  if (found == defined_strings_.end()) fail("found string code {}, which is not defined", code);
  return found->second;
}

/// Reads one encoded token. False for a definition, which leaves `token` as it is.
bool Lexer::encoded(Token& token) {
  const int c = get();
  if (c < 0220) {
    token.kind = Token::Kind::number;
    token.number = encoded_fixed_point((c & 3) + 1, (c >> 2) & 3);
  } else if (c < 0240) {
    token.kind = Token::Kind::string;
    encoded_string(uint32_t(c - 0220), token.text);
  } else if (c < 0244) {
    token.kind = Token::Kind::string;
    encoded_string(encoded_unsigned(c - 0240 + 1), token.text);
  } else if (c == 0244 || c == 0245) {
    token.kind = Token::Kind::number;
    token.number = c == 0244 ? encoded_float() : encoded_double();
  } else if (c == 0246) {
    const uint32_t code = encoded_unsigned(1);
    const auto found = defined_requests_.find(code);
    if (found == defined_requests_.end()) fail("found request code {}, which is not defined", code);
    token.kind = Token::Kind::request;
    token.text = found->second;
  } else if (c >= 0310 && c < 0314) {
    const uint32_t count = encoded_unsigned(c - 0310 + 1);
    if (count > longest_array)
      fail("an encoded array of {} numbers; at most {} are accepted", count, longest_array);
    token.kind = Token::Kind::numbers;
    token.numbers.clear();
    for (uint32_t i = 0; i < count; ++i) token.numbers.push_back(encoded_float());
  } else if (c == 0314) {
    define_request();
    return false;
  } else if (c == 0315 || c == 0316) {
    define_string(c - 0315 + 1);
    return false;
  } else if (c == 0317 || c == 0320) {
    token.kind = Token::Kind::string;
    token.text = defined_string(encoded_unsigned(c - 0317 + 1));
  } else {
    fail("expected a request, number, string or array, found the byte 0x{:02x}", c);
  }
  return true;
}

}  // namespace tessera
