// The texture filters that there are, on stripes for which each has an answer of its own.

#include <cmath>

#include <catch2/catch.hpp>

#include "base/error.h"
#include "images/exr.h"
#include "images/image_module.h"
#include "temporary_folder.h"

using namespace tessera;

namespace {

constexpr int size = 256, period = 16;
constexpr float texel = 1.0f / size;

double stripe(double s) { return 0.5 + 0.5 * std::cos(2 * M_PI * s * size / period); }

// A cosine in s, constant in t, which is looked up with each filter.
class Stripes {
 public:
  Stripes() {
    Image image(size, size);
    std::vector<float>& values = image.add_channel("Y").values;
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) values[image.index(x, y)] = float(stripe((x + 0.5) / size));
    write_exr(folder_.file("stripes.exr"), image);
  }

  // With a footprint of `width` x `height`.
  float lookup(TextureFilter filter, float s, float width, float height) const {
    TextureSettings settings;
    settings.filter = filter;
    const auto module = load_image_module(TESSERA_BINARY_DIR "/tessera_oiio.so");
    const auto sampler = module->make_texture_sampler(settings);
    const float t = 0.4f, none = 0;
    float out = -1;
    const TexturePoints points{{&s, 1}, {&t, 1}, {&width, 1}, {&none, 1}, {&none, 1}, {&height, 1}};
    REQUIRE(
        sampler
            ->sample({.file = folder_.file("stripes.exr"), .channel_count = 1}, points, {&out, 1})
            .found);
    return out;
  }

 private:
  TemporaryFolder folder_;
};

}  // namespace

TEST_CASE("a point lookup gives the texel itself, whatever the footprint") {
  const Stripes stripes;
  for (const float width : {0.0f, texel, 64 * texel})
    for (const int column : {5, 100, 203})
      for (const double within : {0.1, 0.5, 0.9})
        CHECK(stripes.lookup(TextureFilter::point, float((column + within) / size), width, width) ==
              float(stripe((column + 0.5) / size)));
}

TEST_CASE("a bilinear lookup lies between texels, whatever the footprint") {
  const Stripes stripes;
  for (const float width : {0.0f, texel, 64 * texel})
    for (const int column : {5, 100, 203})
      for (const double within : {0.0, 0.25, 0.8}) {
        const double left = stripe((column + 0.5) / size), right = stripe((column + 1.5) / size);
        CHECK(stripes.lookup(TextureFilter::bilinear, float((column + 0.5 + within) / size), width,
                             width) == Approx(left + within * (right - left)).margin(2e-3));
      }
}

TEST_CASE("a trilinear lookup is as wide as the footprint is long, an anisotropic one is not") {
  const Stripes stripes;
  for (const float s : {8.0f / 16, 8.5f / 16}) {  // where it is 1, and 0
    // Narrow across the stripes, long along them.
    CHECK(stripes.lookup(TextureFilter::anisotropic, s, texel, 16 * texel) ==
          Approx(stripe(double(s))).margin(0.06));
    CHECK(stripes.lookup(TextureFilter::trilinear, s, texel, 16 * texel) ==
          Approx(0.5).margin(0.1));
    // A whole stripe wide: the mean, where those that do not filter alias.
    for (const TextureFilter filter : {TextureFilter::trilinear, TextureFilter::anisotropic})
      CHECK(stripes.lookup(filter, s, 32 * texel, 32 * texel) == Approx(0.5).margin(0.06));
    CHECK(std::abs(stripes.lookup(TextureFilter::bilinear, s, 32 * texel, 32 * texel) - 0.5f) >
          0.4f);
  }
}

TEST_CASE("texture filters have names") {
  for (const TextureFilterDefinition& definition : texture_filter_registry())
    CHECK(find_texture_filter(definition.name).filter == definition.filter);
  CHECK(texture_filter_registry().size() == 4);
  CHECK_THROWS_WITH(find_texture_filter("blurry"), Catch::Matchers::Contains("anisotropic"));
}
