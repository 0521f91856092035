#include "scenes/rib/request_parser.h"

namespace tessera {

namespace {

constexpr size_t most_arguments = size_t(1) << 16;
/// Of one request; defined strings make a few bytes of input stand for many.
constexpr size_t most_string_bytes = size_t(1) << 28;

}  // namespace

std::string describe(const RibValue& value) {
  switch (value.kind) {
    case RibValue::Kind::number:
      return fmt::format("the number {}", value.numbers[0]);
    case RibValue::Kind::string:
      return fmt::format("the string \"{:.60}\"", value.strings[0]);
    case RibValue::Kind::array:
      break;
  }
  if (!value.strings.empty()) return fmt::format("an array of {} strings", value.strings.size());
  return fmt::format("an array of {} numbers", value.numbers.size());
}

void RequestParser::count_string() {
  // The fixed part covers the string object itself, so that empty strings count too.
  string_bytes_ += token_.text.size() + sizeof(std::string);
  if (string_bytes_ > most_string_bytes)
    throw Error(where(),
                fmt::format("more than {} bytes of strings in one request", most_string_bytes));
}

void RequestParser::array(RibValue& value) {
  const SourceLocation begun = where();
  value.kind = RibValue::Kind::array;
  for (lexer_.next(token_); token_.kind != Token::Kind::array_end; lexer_.next(token_)) {
    const bool number = token_.kind == Token::Kind::number;
    if (!number && token_.kind != Token::Kind::string)
      throw Error(where(), fmt::format("expected a value or ']' in the array begun on line {}, "
                                       "found {}",
                                       begun.line, describe(token_)));
    if (number ? !value.strings.empty() : !value.numbers.empty())
      throw Error(where(),
                  fmt::format("expected {} only in the array begun on line {}, found {}",
                              number ? "strings" : "numbers", begun.line, describe(token_)));
    if (value.numbers.size() == longest_array)
      throw Error(begun, fmt::format("an array of more than {} values", longest_array));
    if (number) {
      value.numbers.push_back(token_.number);
    } else {
      count_string();
      value.strings.push_back(token_.text);
    }
  }
}

bool RequestParser::next(RibRequest& request) {
  if (token_.kind == Token::Kind::end) return false;
  if (token_.kind != Token::Kind::request)
    throw Error(where(), fmt::format("expected a request, found {}", describe(token_)));
  request.name = token_.text;
  request.where = where();
  request.values.clear();
  string_bytes_ = 0;
  for (lexer_.next(token_);; lexer_.next(token_)) {
    const bool more = token_.kind != Token::Kind::request && token_.kind != Token::Kind::end;
    if (!more) return true;
    if (request.values.size() == most_arguments)
      throw Error(where(),
                  fmt::format("{} has more than {} arguments", request.name, most_arguments));
    RibValue& value = request.values.emplace_back();
    switch (token_.kind) {
      case Token::Kind::number:
        value.numbers.push_back(token_.number);
        break;
      case Token::Kind::string:
        count_string();
        value.kind = RibValue::Kind::string;
        value.strings.push_back(token_.text);
        break;
      case Token::Kind::numbers:
        value.kind = RibValue::Kind::array;
        value.numbers = token_.numbers;
        break;
      case Token::Kind::array_begin:
        array(value);
        break;
      default:
        throw Error(where(), fmt::format("expected an argument of {}, found {}", request.name,
                                         describe(token_)));
    }
  }
}

}  // namespace tessera
