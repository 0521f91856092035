// Encoded pixels against a decoder of its own: bits taken apart by hand, powers of two by ldexp.
#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <random>

#include <zlib.h>

#include "base/error.h"
#include "report/encode.h"

namespace tessera {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

int digit_value(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

std::vector<uint8_t> from_base64(const std::string& text) {
  std::vector<uint8_t> bytes;
  unsigned bits = 0;
  int held = 0;
  for (const char c : text) {
    if (c == '=') break;
    REQUIRE(digit_value(c) >= 0);
    bits = (bits << 6 | unsigned(digit_value(c))) & 0xffffff;
    held += 6;
    if (held >= 8) bytes.push_back(uint8_t(bits >> (held -= 8)));
  }
  return bytes;
}

std::vector<uint8_t> inflated(const EncodedImage& image, size_t size) {
  const std::vector<uint8_t> packed = from_base64(image.text);
  std::vector<uint8_t> bytes(size + 1);
  uLongf got = bytes.size();
  REQUIRE(uncompress(bytes.data(), &got, packed.data(), packed.size()) == Z_OK);
  REQUIRE(got == size);
  bytes.resize(size);
  return bytes;
}

double half_value(unsigned bits) {
  const double sign = bits & 0x8000 ? -1.0 : 1.0;
  const int exponent = int(bits >> 10 & 31), mantissa = int(bits & 1023);
  if (exponent == 31) return mantissa ? double(nan) : sign * double(infinity);
  if (exponent == 0) return sign * std::ldexp(mantissa, -24);
  return sign * std::ldexp(1024 + mantissa, exponent - 25);
}

/// Sums up the 16-bit entries of plane `index`.
std::vector<unsigned> plane_of(const std::vector<uint8_t>& bytes, size_t index, size_t count) {
  std::vector<unsigned> plane(count);
  unsigned sum = 0;
  for (size_t i = 0; i < count; ++i) {
    sum += 256u * bytes[2 * index * count + i] + bytes[(2 * index + 1) * count + i];
    plane[i] = sum % 65536;
  }
  return plane;
}

/// Values of R, G and B.
std::array<std::vector<double>, 3> decoded(const EncodedImage& image) {
  const size_t count = size_t(image.width) * size_t(image.height);
  const std::vector<uint8_t> bytes = inflated(image, 6 * count);
  const auto g = plane_of(bytes, 0, count), r = plane_of(bytes, 1, count),
             b = plane_of(bytes, 2, count);
  std::array<std::vector<double>, 3> values;
  for (size_t i = 0; i < count; ++i) {
    values[0].push_back(half_value((r[i] + g[i]) % 65536));
    values[1].push_back(half_value(g[i]));
    values[2].push_back(half_value((b[i] + g[i]) % 65536));
  }
  return values;
}

Image image_of(int width, int height, const std::vector<float>& r, const std::vector<float>& g,
               const std::vector<float>& b) {
  Image image(width, height);
  image.add_channel("B").values = b;
  image.add_channel("R").values = r;
  image.add_channel("A");
  image.add_channel("G").values = g;
  return image;
}

}  // namespace

TEST_CASE("Encoded colours are within half a unit of eleven bits") {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> exponent(-13.9f, 15.9f), unit(0.0f, 1.0f);
  constexpr int width = 31, height = 17;
  std::array<std::vector<float>, 3> values;
  for (auto& channel : values)
    for (int i = 0; i < width * height; ++i)
      channel.push_back(std::exp2(exponent(random)) * (unit(random) < 0.3f ? -1.0f : 1.0f));
  const EncodedImage image =
      encode_colour(image_of(width, height, values[0], values[1], values[2]));
  CHECK(image.width == width);
  CHECK(image.height == height);
  const auto got = decoded(image);
  double worst = 0.0;
  for (size_t c = 0; c < 3; ++c)
    for (size_t i = 0; i < values[c].size(); ++i)
      worst = std::max(worst, std::abs(got[c][i] - values[c][i]) / std::abs(double(values[c][i])));
  CHECK(worst <= std::ldexp(1.0, -11));
  CHECK(worst > std::ldexp(1.0, -13));  // the bound is that of halves, not of floats
}

TEST_CASE("Encoded colours keep what is no ordinary number") {
  const std::vector<float> values = {0.0f,   -0.0f,    nan,      infinity, -infinity, 1e30f,
                                     -1e30f, 65504.0f, 65520.0f, 1e-7f,    1e-30f,    -2.5f};
  const std::vector<double> expected = {
      0.0,     0.0,      double(nan), double(infinity), -double(infinity),
      65504.0, -65504.0, 65504.0,     65504.0,          1e-7,
      0.0,     -2.5};
  const std::vector<float> plain(values.size(), 1.0f);
  for (size_t channel = 0; channel < 3; ++channel) {
    std::array<std::vector<float>, 3> rgb = {plain, plain, plain};
    rgb[channel] = values;
    const auto got = decoded(encode_colour(image_of(4, 3, rgb[0], rgb[1], rgb[2])));
    for (size_t i = 0; i < values.size(); ++i) {
      CAPTURE(channel, i, values[i], got[channel][i]);
      if (std::isnan(expected[i]))
        CHECK(std::isnan(got[channel][i]));
      else if (std::isinf(expected[i]))
        CHECK(got[channel][i] == expected[i]);
      else
        CHECK(std::abs(got[channel][i] - expected[i]) <= std::ldexp(1.0, -25));
      CHECK(got[(channel + 1) % 3][i] == 1.0);  // the other channels are left alone
    }
  }
}

TEST_CASE("Encoded scalars are exact") {
  const std::vector<float> values = {0.0f, 1.0f, 3.0f, 70001.0f, 1e30f, -2.25f, 1e-40f, infinity};
  Image image(4, 2);
  image.add_channel("tests").values = values;
  const std::vector<uint8_t> bytes = inflated(encode_scalar(image, "tests"), 4 * values.size());
  for (size_t i = 0; i < values.size(); ++i) {
    unsigned bits = 0;
    for (size_t place = 0; place < 4; ++place) bits = bits * 256 + bytes[place * values.size() + i];
    const int exponent = int(bits >> 23 & 255);
    const double fraction = double(bits & 0x7fffff);
    const double size = exponent == 0     ? std::ldexp(fraction, -149)
                        : exponent == 255 ? double(infinity)
                                          : std::ldexp(fraction + 0x800000, exponent - 150);
    CHECK((bits >> 31 ? -size : size) == double(values[i]));
  }
}

TEST_CASE("Base64 is that of RFC 4648") {
  const std::pair<const char*, const char*> vectors[] = {// section 10
                                                         {"", ""},
                                                         {"f", "Zg=="},
                                                         {"fo", "Zm8="},
                                                         {"foo", "Zm9v"},
                                                         {"foob", "Zm9vYg=="},
                                                         {"fooba", "Zm9vYmE="},
                                                         {"foobar", "Zm9vYmFy"}};
  for (const auto& [plain, text] : vectors) {
    const std::string_view view = plain;
    CHECK(base64({reinterpret_cast<const uint8_t*>(view.data()), view.size()}) == text);
  }
  const uint8_t high[] = {0xfb, 0xff, 0xfe};
  CHECK(base64(high) == "+//+");
}

TEST_CASE("An image without the channels asked for is an error") {
  Image image(2, 2);
  image.add_channel("R");
  image.add_channel("G");
  CHECK_THROWS_AS(encode_colour(image), Error);
  CHECK_THROWS_AS(encode_scalar(image, "tests"), Error);
}

}  // namespace tessera
