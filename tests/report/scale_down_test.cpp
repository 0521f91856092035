// Smaller images against sums written out.
#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

#include "report/scale_down.h"

namespace tessera {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

Image image_of(int width, int height, const std::vector<float>& values) {
  Image image(width, height);
  image.add_channel("other", PixelType::float32, 7.0f);
  image.add_channel("R").values = values;
  return image;
}

std::vector<float> reduced(const Image& image, int n) {
  const std::vector<std::string> names = {"R", "none"};
  const Image small = scaled_down(image, n, names);
  REQUIRE(small.channels.size() == 1);
  return small.channels[0].values;
}

}  // namespace

TEST_CASE("A smaller image has the means of its pixels, of fewer at the edges") {
  const Image image = image_of(5, 3,
                               {1, 2, 3, 4, 5,   //
                                6, 7, 8, 9, 10,  //
                                20, 30, 40, 50, 60});
  CHECK(reduced(image, 2) == std::vector<float>{(1 + 2 + 6 + 7) / 4.0f, (3 + 4 + 8 + 9) / 4.0f,
                                                (5 + 10) / 2.0f,  // one column
                                                25, 45, 60});     // one row
  CHECK(reduced(image, 1) == image.find_channel("R")->values);
  CHECK(reduced(image, 9) == std::vector<float>{17});
}

TEST_CASE("A crop is made smaller from its own corner") {
  Image image({0, 0, 100, 100}, {51, 33, 53, 35});
  image.add_channel("R").values = {1, 2, 3, 6};
  CHECK(reduced(image, 2) == std::vector<float>{3});
}

TEST_CASE("What is no number stays none in a smaller image, and touches its own pixel alone") {
  const std::vector<float> small = reduced(image_of(6, 2,
                                                    {nan, 1, infinity, 1, 3e38f, 3e38f,  //
                                                     1, 1, 1, 1, 3e38f, 3e38f}),
                                           2);
  CHECK(std::isnan(small[0]));
  CHECK(small[1] == infinity);
  CHECK(small[2] == 3e38f);
}

TEST_CASE("Images are reduced by the least whole number that fits") {
  const auto reduction = [](int width, int height) {
    return report_reduction(Image(width, height));
  };
  CHECK(reduction(1, 1) == 1);
  CHECK(reduction(1280, 720) == 1);
  CHECK(reduction(1281, 720) == 2);
  CHECK(reduction(1920, 1080) == 2);
  CHECK(reduction(720, 2560) == 2);
  CHECK(reduction(3840, 2160) == 3);
}

}  // namespace tessera
