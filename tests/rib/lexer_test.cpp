/// Tokens, in ASCII and in the binary encoding, against an encoder written from the specification.

#include <bit>
#include <cmath>
#include <limits>

#include "rib_test_utils.h"
#include "scenes/rib/lexer.h"

using namespace tessera;
using namespace tessera::test;

namespace {

std::vector<Token> tokens_of(std::string_view text) {
  Lexer lexer(ByteSource::from_text(text, "tokens"));
  std::vector<Token> tokens;
  for (;;) {
    Token token;
    lexer.next(token);
    if (token.kind == Token::Kind::end) return tokens;
    tokens.push_back(token);
  }
}

std::string lex_error(std::string_view text) {
  try {
    tokens_of(text);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

std::string big_endian(uint64_t value, int bytes) {
  std::string out;
  for (int i = bytes - 1; i >= 0; --i) out.push_back(char((value >> (8 * i)) & 0xff));
  return out;
}

std::string fixed_point(int32_t raw, int bytes, int fraction_bytes) {
  return std::string(1, char(0200 + 4 * fraction_bytes + bytes - 1)) +
         big_endian(uint32_t(raw), bytes);
}

std::string encoded_float(float value) {
  return std::string(1, char(0244)) + big_endian(std::bit_cast<uint32_t>(value), 4);
}

std::string encoded_double(double value) {
  return std::string(1, char(0245)) + big_endian(std::bit_cast<uint64_t>(value), 8);
}

std::string encoded_string(const std::string& text) {
  if (text.size() < 16) return std::string(1, char(0220 + text.size())) + text;
  return std::string(1, char(0241)) + big_endian(text.size(), 2) + text;
}

}  // namespace

TEST_CASE("numbers in every ASCII spelling") {
  const auto tokens = tokens_of("1 -2 +3 4.5 .5 5. -1e3 1E-2 +.25e+2 1e-400 007");
  const std::vector<double> expected{1, -2, 3, 4.5, 0.5, 5, -1000, 0.01, 25, 0, 7};
  REQUIRE(tokens.size() == expected.size());
  for (size_t i = 0; i < expected.size(); ++i) {
    CHECK(tokens[i].kind == Token::Kind::number);
    CHECK(tokens[i].number == expected[i]);
  }
}

TEST_CASE("what is no finite number is refused with its line") {
  for (const char* bad : {"nan", "inf", "-inf", "+nan", "Infinity", "1e999", "-1e999", "1.2.3",
                          "--1", "+-1", "+", ".", "1e", "0x10", "12abc"}) {
    CAPTURE(bad);
    CHECK_THAT(lex_error(std::string("1\n2 ") + bad), Contains("tokens:2: expected a finite"));
  }
}

TEST_CASE("strings, escapes, comments and arrays") {
  const auto tokens = tokens_of(
      "##RenderMan RIB\nFoo_1 \"a\\n\\t\\\"\\\\\\101\\\nb\" # comment [ \"\n[1]\r\nBar\"\"");
  REQUIRE(tokens.size() == 7);
  CHECK(tokens[0].kind == Token::Kind::request);
  CHECK(tokens[0].text == "Foo_1");
  CHECK(tokens[1].text == "a\n\t\"\\Ab");
  CHECK(tokens[2].kind == Token::Kind::array_begin);
  CHECK(tokens[3].number == 1);
  CHECK(tokens[4].kind == Token::Kind::array_end);
  CHECK(tokens[5].text == "Bar");
  CHECK(tokens[6].kind == Token::Kind::string);
  CHECK(tokens[6].text.empty());
  CHECK_THAT(lex_error("\n\"open"), Contains("inside the string begun on line 2"));
  CHECK_THAT(lex_error("$"), Contains("found '$'"));
  CHECK_THAT(lex_error(std::string_view("\0", 1)), Contains("found the byte 0x00"));
}

TEST_CASE("encoded numbers") {
  for (int bytes = 1; bytes <= 4; ++bytes)
    for (int fraction = 0; fraction <= 3; ++fraction)
      for (int64_t raw : {int64_t(0), int64_t(1), int64_t(-1), (int64_t(1) << (8 * bytes - 1)) - 1,
                          -(int64_t(1) << (8 * bytes - 1))}) {
        const auto tokens = tokens_of(fixed_point(int32_t(raw), bytes, fraction));
        REQUIRE(tokens.size() == 1);
        CHECK(tokens[0].number == double(raw) / std::pow(256.0, fraction));
      }
  for (float value : {0.0f, -1.5f, 3.4e38f, 1e-45f})
    CHECK(tokens_of(encoded_float(value)).at(0).number == double(value));
  for (double value : {0.0, -1.0 / 3.0, 1e300})
    CHECK(tokens_of(encoded_double(value)).at(0).number == value);
  CHECK_THAT(lex_error(encoded_float(NAN)), Contains("finite"));
  CHECK_THAT(lex_error(encoded_double(INFINITY)), Contains("finite"));
}

TEST_CASE("encoded strings, arrays and definitions, mixed with ASCII") {
  const std::string long_text(300, 'x');
  std::string text = encoded_string("short") + encoded_string(long_text);
  text += std::string("\314\001\"Sphere\"") + "\246\001";                // request 1
  text += std::string("\315\005") + encoded_string("Kd") + " \317\005";  // string 5
  text += std::string("\316\001\002 \"two bytes\"") + "\320\001\002";    // string 0x102
  text += std::string("\311") + big_endian(2, 2) + big_endian(std::bit_cast<uint32_t>(1.5f), 4) +
          big_endian(std::bit_cast<uint32_t>(-2.0f), 4) + "7";
  const auto tokens = tokens_of(text);
  REQUIRE(tokens.size() == 7);
  CHECK(tokens[0].text == "short");
  CHECK(tokens[1].text == long_text);
  CHECK(tokens[2].kind == Token::Kind::request);
  CHECK(tokens[2].text == "Sphere");
  CHECK(tokens[3].text == "Kd");
  CHECK(tokens[4].text == "two bytes");
  CHECK(tokens[5].numbers == std::vector<double>{1.5, -2.0});
  CHECK(tokens[6].number == 7);
}

TEST_CASE("broken encodings are refused, and counts alone allocate nothing") {
  CHECK_THAT(lex_error("\246\001"), Contains("request code 1, which is not defined"));
  CHECK_THAT(lex_error("\317\001"), Contains("string code 1, which is not defined"));
  CHECK_THAT(lex_error("\244\001"), Contains("ends inside an encoded token"));
  CHECK_THAT(lex_error("\243\377\377\377\377"), Contains("encoded string of 4294967295 bytes"));
  CHECK_THAT(lex_error("\313\377\377\377\377"), Contains("encoded array of 4294967295 numbers"));
  CHECK_THAT(lex_error("\313\007\377\377\377"), Contains("ends inside an encoded token"));
  CHECK_THAT(lex_error("\377"), Contains("found the byte 0xff"));
}

TEST_CASE("a binary scene reads as its ASCII twin") {
  std::string binary = std::string("\314\001\"WorldBegin\"\314\002\"WorldEnd\"\314\003\"Patch\"") +
                       "\315\001" + encoded_string("bilinear") + "\246\001 Translate " +
                       fixed_point(0x180, 2, 1) + encoded_float(0.25f) + encoded_double(-3.0) +
                       "\246\003\317\001\"P\"\310\014";
  const float P[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0.5f};
  for (float value : P) binary += big_endian(std::bit_cast<uint32_t>(value), 4);
  binary += "\246\002";
  const auto a = read_text(binary);
  const auto b = read_text(
      "WorldBegin Translate 1.5 .25 -3 Patch \"bilinear\" \"P\" [0 0 0 1 0 0 0 1 0 1 1 .5] "
      "WorldEnd");
  REQUIRE(a.scene().surfaces.size() == 1);
  REQUIRE(b.scene().surfaces.size() == 1);
  CHECK(a.scene().surfaces[0].geometry->P_object == b.scene().surfaces[0].geometry->P_object);
  CHECK(a.scene().surfaces[0].world_from_object.matrices() ==
        b.scene().surfaces[0].world_from_object.matrices());
}
