#include "scenes/rib/lexer.h"

#include <charconv>
#include <cmath>

namespace tessera {

namespace {

constexpr size_t longest_word = 256;

bool is_space(int c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
bool is_letter(int c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_digit(int c) { return c >= '0' && c <= '9'; }
bool starts_number(int c) { return is_digit(c) || c == '+' || c == '-' || c == '.'; }

std::string printable(int c) {
  return c > ' ' && c < 127 ? fmt::format("'{}'", char(c)) : fmt::format("the byte 0x{:02x}", c);
}

/// Whether a word is one of the spellings C libraries print for what is not a finite number.
bool is_not_a_number(std::string word) {
  for (char& c : word)
    if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
  return word == "nan" || word == "inf" || word == "infinity";
}

}  // namespace

std::string describe(const Token& token) {
  switch (token.kind) {
    case Token::Kind::request:
      return fmt::format("the request {}", token.text);
    case Token::Kind::string:
      return fmt::format("the string \"{:.60}\"", token.text);
    case Token::Kind::number:
      return fmt::format("the number {}", token.number);
    case Token::Kind::numbers:
      return "an array of numbers";
    case Token::Kind::array_begin:
      return "'['";
    case Token::Kind::array_end:
      return "']'";
    case Token::Kind::end:
      return "the end of the file";
  }
  return "";
}

int Lexer::get() {
  const int c = source_.get();
  if (c == '\n') ++line_;
  return c;
}

void Lexer::skip_space_and_comments() {
  for (int c = source_.peek(); is_space(c) || c == '#'; c = source_.peek()) {
    if (c == '#')
      while (source_.peek() != -1 && source_.peek() != '\n' && source_.peek() != '\r') get();
    else
      get();
  }
}

void Lexer::next(Token& token) {
  do {
    skip_space_and_comments();
    const int c = source_.peek();
    if (c == -1) {
      token.kind = Token::Kind::end;
      return;
    }
    if (starts_number(c)) return ascii_number(token);
    if (is_letter(c)) return request(token);
    if (c < 128) {
      get();
      if (c == '"') {
        token.kind = Token::Kind::string;
        return quoted_string(token.text);
      }
      if (c != '[' && c != ']')
        fail("expected a request, number, string or array, found {}", printable(c));
      token.kind = c == '[' ? Token::Kind::array_begin : Token::Kind::array_end;
      return;
    }
    // Definitions are no tokens of their own: read on after them.
  } while (!encoded(token));
}

void Lexer::request(Token& token) {
  token.kind = Token::Kind::request;
  token.text.clear();
  while (is_letter(source_.peek()) || is_digit(source_.peek())) {
    if (token.text.size() == longest_word)
      fail("expected the name of a request, found a word longer than {} letters", longest_word);
    token.text.push_back(char(get()));
  }
  if (is_not_a_number(token.text)) fail("expected a finite number, found {}", token.text);
}

void Lexer::ascii_number(Token& token) {
  token.kind = Token::Kind::number;
  scratch_.clear();
  for (int c = source_.peek(); starts_number(c) || is_letter(c); c = source_.peek()) {
    if (scratch_.size() == longest_word)
      fail("expected a number, found a word longer than {} characters", longest_word);
    scratch_.push_back(char(get()));
  }
  const char* first = scratch_.data();
  const char* last = first + scratch_.size();
  // from_chars knows no leading plus; it does know "inf" and "nan", which are refused below.
  if (*first == '+' && scratch_.size() > 1 && first[1] != '-') ++first;
  const auto [stop, status] = std::from_chars(first, last, token.number);
  if (status == std::errc::result_out_of_range && stop == last) {
    // Too small is zero, too large is an error; the sign of the exponent tells which.
    if (scratch_.find("e-") == std::string::npos && scratch_.find("E-") == std::string::npos)
      fail("expected a finite number, found {}", scratch_);
    token.number = 0.0;
    return;
  }
  if (status != std::errc() || stop != last || !std::isfinite(token.number))
    fail("expected a finite number, found {}", scratch_);
}

void Lexer::quoted_string(std::string& text) {
  text.clear();
  const int begun = line_;
  for (;;) {
    const int c = get();
    if (c == '"') return;
    if (c == -1) fail("the file ends inside the string begun on line {}", begun);
    if (text.size() == longest_string)
      fail("the string begun on line {} is longer than {} bytes", begun, longest_string);
    if (c != '\\') {
      text.push_back(char(c));
      continue;
    }
    const int escaped = escaped_character();
    if (escaped >= 0) text.push_back(char(escaped));
  }
}

/// The character after a backslash; -1 for an escaped line end, which stands for nothing.
int Lexer::escaped_character() {
  const int c = get();
  switch (c) {
    case 'n':
      return '\n';
    case 'r':
      return '\r';
    case 't':
      return '\t';
    case 'b':
      return '\b';
    case 'f':
      return '\f';
    case '\n':
      return -1;
    case -1:
      fail("the file ends inside a string");
    default:
      break;
  }
  if (c < '0' || c > '7') return c;
  int value = c - '0';
  for (int digits = 1; digits < 3 && source_.peek() >= '0' && source_.peek() <= '7'; ++digits)
    value = value * 8 + (get() - '0');
  return value & 0xff;
}

}  // namespace tessera
