#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

#include "base/error.h"
#include "images/compare.h"
#include "images/preview.h"

using namespace tessera;

TEST_CASE("differences by hand") {
  Image a(2, 2), b(2, 2);
  a.add_channel("R").values = {0, 1, 2, 3};
  b.add_channel("R").values = {0, 1.5f, 2, 1};
  a.add_channel("A");
  b.add_channel("Z");
  const ImageDifference d = compare_images(a, b);
  // Errors 0, -0.5, 0, 2.
  CHECK(d.rmse == Approx(std::sqrt((0.25 + 4) / 4)));
  CHECK(d.rel_mse == Approx((0.25 / 2.26 + 4 / 1.01) / 4));
  CHECK(d.psnr_db == Approx(-10 * std::log10(4.25 / 4)));
  CHECK(d.largest == 2.0);
  CHECK(d.largest_x == 1);
  CHECK(d.largest_y == 1);
  CHECK(d.largest_channel == "R");
  CHECK(d.values == 4);
  CHECK(d.only_in_a == std::vector<std::string>{"A"});
  CHECK(d.only_in_b == std::vector<std::string>{"Z"});
}

TEST_CASE("equal images differ by nothing, NaN included") {
  Image a({0, 0, 9, 9}, {3, 4, 5, 5});
  a.add_channel("R").values = {std::numeric_limits<float>::quiet_NaN(), 1};
  const ImageDifference d = compare_images(a, a);
  CHECK(d.rmse == 0.0);
  CHECK(d.largest == 0.0);
  CHECK(std::isinf(d.psnr_db));
  CHECK(d.nonfinite_mismatches == 0);
  CHECK(d.largest_channel.empty());
}

TEST_CASE("a NaN on one side is counted, and does not spread") {
  const float inf = std::numeric_limits<float>::infinity();
  Image a({0, 0, 9, 9}, {3, 4, 6, 5}), b = a;
  a.add_channel("R").values = {1, std::nanf(""), inf};
  b.add_channel("R").values = {2, 0, -inf};
  const ImageDifference d = compare_images(a, b);
  CHECK(d.rmse == 1.0);
  CHECK(d.nonfinite_mismatches == 2);
  CHECK(std::isinf(d.largest));
  CHECK(d.largest_x == 4);
  CHECK(d.largest_y == 4);
}

TEST_CASE("images of other pixels or channels cannot be compared") {
  Image a(2, 2), b(2, 3), c(2, 2);
  a.add_channel("R"), b.add_channel("R"), c.add_channel("Z");
  CHECK_THROWS_AS(compare_images(a, b), Error);
  CHECK_THROWS_AS(compare_images(a, c), Error);
}

TEST_CASE("sRGB code values") {
  CHECK(srgb8_from_linear(0.0f) == 0);
  CHECK(srgb8_from_linear(-1.0f) == 0);
  CHECK(srgb8_from_linear(std::nanf("")) == 0);
  CHECK(srgb8_from_linear(1.0f) == 255);
  CHECK(srgb8_from_linear(1e30f) == 255);
  CHECK(srgb8_from_linear(0.18f) == 118);    // 117.6, the well-known middle grey
  CHECK(srgb8_from_linear(0.003f) == 10);    // the linear part: 12.92 * 0.003 * 255 = 9.88
  CHECK(srgb8_from_linear(0.2140f) == 127);  // 0.49998 by the standard's formula
  for (int code = 0; code < 256; ++code) {
    const double v = code / 255.0;
    const double linear = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    CHECK(int(srgb8_from_linear(float(linear))) == code);
  }
}

TEST_CASE("previews show colours over black, or keep alpha") {
  Image image(2, 1);
  image.add_channel("A").values = {0.5f, 0.0f};
  image.add_channel("R").values = {0.5f, 0.0f};
  image.add_channel("G").values = {0.0f, 0.0f};
  image.add_channel("B").values = {0.25f, 0.0f};
  CHECK(make_preview(image).pixels == std::vector<uint8_t>{188, 0, 137, 0, 0, 0});
  CHECK(make_preview(image, true).pixels == std::vector<uint8_t>{255, 0, 188, 128, 0, 0, 0, 0});

  Image depth(1, 1);
  depth.add_channel("Z", PixelType::float32, 1.0f);
  CHECK(make_preview(depth).pixels == std::vector<uint8_t>{255, 255, 255});
}
