#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

#include "base/error.h"
#include "images/perceptual.h"

using namespace tessera;
using Catch::Matchers::Contains;

namespace {

constexpr int width = 96, height = 64;

Image flat(float value) {
  Image image(width, height);
  for (const char* name : {"R", "G", "B"}) image.add_channel(name, PixelType::float32, value);
  return image;
}

/// Adds `amount` to every colour of the pixels of a rectangle.
Image with_rectangle(Image image, const PixelRect& rect, float amount) {
  for (Image::Channel& channel : image.channels)
    for (int y = rect.y0; y < rect.y1; ++y)
      for (int x = rect.x0; x < rect.x1; ++x) channel.values[image.index(x, y)] += amount;
  return image;
}

}  // namespace

TEST_CASE("nobody sees a difference between equal images") {
  CHECK(visible_share(flat(0.5f), flat(0.5f)) == 0.0);
  const Image pattern = with_rectangle(flat(0.1f), {10, 10, 40, 30}, 0.7f);
  CHECK(visible_share(pattern, pattern) == 0.0);
}

TEST_CASE("everybody sees a gross difference, wherever it is") {
  CHECK(visible_share(flat(0.9f), flat(0.1f)) == 1.0);
  CHECK(visible_share(flat(0.1f), flat(0.9f)) == 1.0);
  // A rectangle of a sixth of the picture: its own pixels, and some around it that it dazzles.
  const PixelRect rect{16, 16, 48, 48};
  const double seen = visible_share(with_rectangle(flat(0.1f), rect, 0.8f), flat(0.1f));
  CHECK(seen >= 32.0 * 32.0 / (width * height));
  CHECK(seen < 0.5);
}

TEST_CASE("nobody sees a difference of a thousandth") {
  CHECK(visible_share(flat(0.5f), flat(0.5005f)) == 0.0);
  CHECK(visible_share(with_rectangle(flat(0.4f), {8, 8, 60, 60}, 4e-4f), flat(0.4f)) == 0.0);
}

// In an even field the threshold is that of Ward Larson et al. alone: at 50 cd/m^2, log10 = 1.69897
// and 10^((0.249 * 1.69897 + 0.65)^2.7 - 0.72) = 3.088 cd/m^2, or 0.0309 of white.
TEST_CASE("in an even field a difference is seen from the eye's threshold on") {
  // Adaptation is to the mean of the two.
  CHECK(visible_share(flat(0.5f - 0.0150f), flat(0.5f + 0.0150f)) == 0.0);
  CHECK(visible_share(flat(0.5f - 0.0165f), flat(0.5f + 0.0165f)) == 1.0);
}

TEST_CASE("colours of one luminance are told apart") {
  // R and G change so that 0.2126 R + 0.7152 G does not.
  Image reddish = flat(0.5f);
  for (float& r : reddish.channels[0].values) r += 0.1f * 0.7152f;
  for (float& g : reddish.channels[1].values) g -= 0.1f * 0.2126f;
  CHECK(visible_share(reddish, flat(0.5f)) == 1.0);
}

TEST_CASE("strong fine detail hides what would be seen in an even field") {
  // Stripes two pixels wide between 0.1 and 0.9; a grey shift of 0.06, twice the even threshold.
  Image stripes = flat(0.1f);
  for (int x = 0; x + 2 <= width; x += 4)
    stripes = with_rectangle(stripes, {x, 0, x + 2, height}, 0.8f);
  const Image shifted = with_rectangle(stripes, {0, 0, width, height}, 0.06f);
  CHECK(visible_share(flat(0.5f), flat(0.56f)) == 1.0);
  CHECK(visible_share(stripes, shifted) == 0.0);
}

TEST_CASE("a value that is not finite is seen once, and does not spread") {
  Image broken = flat(0.5f), other = flat(0.5f);
  broken.channels[1].values[broken.index(30, 20)] = std::nanf("");
  broken.channels[0].values[broken.index(60, 40)] = std::numeric_limits<float>::infinity();
  CHECK(visible_share(broken, other) == Approx(2.0 / (width * height)));
  CHECK(visible_share(broken, broken) == 0.0);
}

TEST_CASE("images without the same pixels and colours are refused") {
  CHECK_THROWS_WITH(visible_share(flat(0.5f), Image(width, height)), Contains("lacks R"));
  Image smaller(width, height - 1);
  for (const char* name : {"R", "G", "B"}) smaller.add_channel(name);
  CHECK_THROWS_WITH(visible_share(flat(0.5f), smaller), Contains("same pixels"));
}
