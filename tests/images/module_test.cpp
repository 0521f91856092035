#include <catch2/catch.hpp>

#include <cmath>
#include <fstream>
#include <thread>

#include "base/error.h"
#include "images/exr.h"
#include "images/image_module.h"
#include "images/preview.h"
#include "temporary_folder.h"

using namespace tessera;

namespace {

const std::string module_file = TESSERA_BINARY_DIR "/tessera_oiio.so";

/// R rises from left to right, G from top to bottom, B is their product.
Image ramp(int size) {
  Image image(size, size);
  for (const char* name : {"R", "G", "B"}) image.add_channel(name);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const float s = (float(x) + 0.5f) / float(size), t = (float(y) + 0.5f) / float(size);
      image.channels[0].values[image.index(x, y)] = s;
      image.channels[1].values[image.index(x, y)] = t;
      image.channels[2].values[image.index(x, y)] = s * t;
    }
  }
  return image;
}

struct Points {
  std::vector<float> s, t, dsdx, dtdx, dsdy, dtdy;
  void add(float ps, float pt, float width) {
    s.push_back(ps), t.push_back(pt);
    dsdx.push_back(width), dtdx.push_back(0), dsdy.push_back(0), dtdy.push_back(width);
  }
  void add_footprint(float ps, float pt, float ds_x, float dt_x, float ds_y, float dt_y) {
    s.push_back(ps), t.push_back(pt);
    dsdx.push_back(ds_x), dtdx.push_back(dt_x), dsdy.push_back(ds_y), dtdy.push_back(dt_y);
  }
  TexturePoints view() const { return {s, t, dsdx, dtdx, dsdy, dtdy}; }
};

}  // namespace

TEST_CASE("the module writes 8-bit pictures in sRGB and reads them back") {
  const TemporaryFolder folder;
  const auto module = load_image_module(module_file);
  Image image = ramp(16);
  image.metadata["Software"] = "tessera";
  for (const char* name : {"a.png", "a.PNG", "a.tif", "a.exr"}) {
    INFO(name);
    module->write_image(folder.file(name), image);
    const Image read = module->read_image(folder.file(name));
    REQUIRE(read.channels.size() == 3);
    REQUIRE(read.data_window == image.data_window);
    const bool coded = std::string(name).find('.') == 1 && std::toupper(name[2]) == 'P';
    for (size_t c = 0; c < 3; ++c) {
      const auto& written = image.find_channel(read.channels[c].name)->values;
      for (size_t i = 0; i < written.size(); ++i) {
        const float expected = coded ? float(srgb8_from_linear(written[i])) / 255.0f : written[i];
        REQUIRE(read.channels[c].values[i] == Approx(expected).epsilon(1e-6));
      }
    }
  }
  module->write_image(folder.file("a.jpg"), image);
  CHECK(module->read_image(folder.file("a.jpg")).width() == 16);
  CHECK(folder.entries() == 5);
}

TEST_CASE("the module keeps alpha in PNG files") {
  const TemporaryFolder folder;
  const auto module = load_image_module(module_file);
  Image image(1, 1);
  image.add_channel("R").values = {0.25f};
  image.add_channel("G").values = {0.5f};
  image.add_channel("B").values = {0.0f};
  image.add_channel("A").values = {0.5f};
  module->write_image(folder.file("a.png"), image);
  std::ifstream file(folder.file("a.png"), std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(file)), {});
  CHECK(bytes[25] == 6);  // the header's colour type: RGB with alpha
  const Image read = module->read_image(folder.file("a.png"));
  REQUIRE(read.channels.size() == 4);
  CHECK(read.find_channel("A")->values[0] == Approx(128.0 / 255.0));
}

TEST_CASE("the module refuses what it cannot do") {
  const TemporaryFolder folder;
  const auto module = load_image_module(module_file);
  CHECK_THROWS_WITH(module->write_image(folder.file("a.xyz"), ramp(4)), Catch::Contains(".png"));
  CHECK_THROWS_AS(module->write_image(folder.file("no/a.png"), ramp(4)), Error);
  CHECK_THROWS_AS(module->write_image(folder.file("a.png"), Image(0, 0)), Error);
  CHECK_THROWS_AS(module->read_image(folder.file("a.png")), Error);
  CHECK(folder.entries() == 0);
}

TEST_CASE("a module that is not there is an error with its name") {
  CHECK_THROWS_WITH(load_image_module("/nowhere/tessera_oiio.so"),
                    Catch::Contains("/nowhere/tessera_oiio.so"));
  const TemporaryFolder folder;
  const std::string text = folder.file("text.so");
  std::ofstream(text) << "not a shared object";
  CHECK_THROWS_WITH(load_image_module(text), Catch::Contains(text));
  setenv("TESSERA_IMAGE_MODULE", "/elsewhere.so", 1);
  CHECK_THROWS_WITH(load_image_module(), Catch::Contains("/elsewhere.so"));
  unsetenv("TESSERA_IMAGE_MODULE");
  CHECK_NOTHROW(load_image_module());  // beside the test program
}

TEST_CASE("textures are found along the search path and filtered") {
  const TemporaryFolder folder;
  write_exr(folder.file("ramp.exr"), ramp(64));
  const auto module = load_image_module(module_file);
  const auto sampler =
      module->make_texture_sampler({.cache_bytes = 1 << 24, .search_path = {folder.file("")}});
  Points points;
  for (float s : {0.25f, 0.5f, 0.7f})
    for (float t : {0.3f, 0.6f})
      for (float width : {0.0f, 1.0f / 64, 1.0f / 8}) points.add(s, t, width);
  const size_t count = points.s.size();
  std::vector<float> out(3 * count, -1.0f);
  const TextureResult result = sampler->sample({.file = "ramp.exr"}, points.view(), out);
  REQUIRE(result.found);
  for (size_t i = 0; i < count; ++i) {
    INFO(points.s[i] << " " << points.t[i] << " " << points.dsdx[i]);
    // A ramp filtered symmetrically is itself; the tables of filter weights are coarse.
    CHECK(out[i] == Approx(points.s[i]).margin(5e-3));
    CHECK(out[count + i] == Approx(points.t[i]).margin(5e-3));
    CHECK(out[2 * count + i] == Approx(points.s[i] * points.t[i]).margin(5e-3));
  }

  SECTION("channels can be picked") {
    std::vector<float> green(count);
    REQUIRE(sampler
                ->sample({.file = "ramp.exr", .first_channel = 1, .channel_count = 1},
                         points.view(), green)
                .found);
    CHECK(std::equal(green.begin(), green.end(), out.begin() + long(count)));
  }
  SECTION("a wide footprint gives the mean") {
    Points wide;
    wide.add(0.5f, 0.5f, 1.0f);
    std::vector<float> mean(3);
    REQUIRE(sampler->sample({.file = "ramp.exr"}, wide.view(), mean).found);
    CHECK(mean[0] == Approx(0.5).margin(0.02));
    CHECK(mean[2] == Approx(0.25).margin(0.02));
  }
  SECTION("a NaN coordinate gives 0 and harms no other") {
    Points bad;
    bad.add(std::nanf(""), 0.5f, 0.0f);
    bad.add(0.5f, 0.5f, 0.0f);
    std::vector<float> values(6, -1.0f);
    REQUIRE(sampler->sample({.file = "ramp.exr"}, bad.view(), values).found);
    CHECK(values[0] == 0.0f);
    CHECK(values[1] == Approx(0.5).margin(5e-3));
  }
}

TEST_CASE("long footprints keep stripes along them and average stripes across them") {
  const TemporaryFolder folder;
  const int size = 256, period = 16;
  // A cosine in s, constant in t.
  const double waves = double(size) / period;
  const auto stripe = [&](double s) { return 0.5 + 0.5 * std::cos(2.0 * M_PI * waves * s); };
  Image stripes(size, size);
  auto& values = stripes.add_channel("Y").values;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) values[stripes.index(x, y)] = float(stripe((x + 0.5) / size));
  }
  write_exr(folder.file("stripes.exr"), stripes);
  const auto sampler = load_image_module(module_file)->make_texture_sampler({});
  const float texel = 1.0f / size, bright = 8.0f / 16, dark = 8.5f / 16;
  const auto lookup = [&](const Points& points) {
    std::vector<float> out(points.s.size(), -1.0f);
    REQUIRE(
        sampler
            ->sample({.file = folder.file("stripes.exr"), .channel_count = 1}, points.view(), out)
            .found);
    return out;
  };

  SECTION("sixteen to one, along either axis of the cell, and turned cells") {
    Points points;
    for (float s : {bright, dark}) {
      points.add_footprint(s, 0.4f, texel, 0, 0, 16 * texel);
      points.add_footprint(s, 0.4f, 0, 16 * texel, texel, 0);
    }
    for (float s : {bright, dark}) {
      points.add_footprint(s, 0.4f, 16 * texel, 0, 0, texel);
      points.add_footprint(s, 0.4f, 0, texel, 16 * texel, 0);
      points.add_footprint(s, 0.4f, 32 * texel, 0, 0, 2 * texel);
    }
    const std::vector<float> found = lookup(points);
    for (size_t i = 0; i < 2; ++i) CHECK(found[i] == Approx(1.0).margin(0.06));
    for (size_t i = 2; i < 4; ++i) CHECK(found[i] == Approx(0.0).margin(0.06));
    for (size_t i = 4; i < found.size(); ++i) {
      INFO(i);
      CHECK(found[i] == Approx(0.5).margin(0.1));
    }
  }
  SECTION("beyond sixteen the shorter axis widens: blurred rather than aliased") {
    Points points;
    for (float s : {bright, dark}) {
      points.add_footprint(s, 0.4f, texel, 0, 0, 64 * texel);    // as wide as 4 texels: kept
      points.add_footprint(s, 0.4f, 64 * texel, 0, 0, texel);    // the mean
      points.add_footprint(s, 0.4f, texel, 0, 0, 4000 * texel);  // as wide as 250: the mean
    }
    const std::vector<float> found = lookup(points);
    CHECK(found[0] > 0.75f);
    CHECK(found[3] < 0.25f);
    for (size_t i : {1, 2, 4, 5}) {
      INFO(i);
      CHECK(found[i] == Approx(0.5).margin(0.1));
    }
  }
  SECTION("no footprint, no second axis, parallel axes") {
    Points points;
    for (float s : {bright, dark}) {
      points.add_footprint(s, 0.4f, 0, 0, 0, 0);
      points.add_footprint(s, 0.4f, 0, 4 * texel, 0, 0);
      points.add_footprint(s, 0.4f, 0, 4 * texel, 0, 4 * texel);
      points.add_footprint(s, 0.4f, 1e-30f, 0, 0, 1e-30f);
    }
    const std::vector<float> found = lookup(points);
    for (size_t i = 0; i < 4; ++i) CHECK(found[i] == Approx(1.0).margin(0.06));
    for (size_t i = 4; i < 8; ++i) CHECK(found[i] == Approx(0.0).margin(0.06));
  }
  SECTION("a footprint that is not finite gives 0, a huge one the mean") {
    const float nan = std::nanf(""), infinite = HUGE_VALF;
    Points points;
    points.add_footprint(bright, 0.4f, nan, 0, 0, texel);
    points.add_footprint(bright, 0.4f, texel, 0, 0, infinite);
    points.add_footprint(bright, 0.4f, texel, 0, 0, texel);
    for (float huge : {2.0f, 1e4f, 1e8f, 1e30f}) {
      points.add_footprint(bright, 0.4f, huge, 0, 0, huge);
      points.add_footprint(bright, 0.4f, huge, 0, 0, texel);
    }
    const std::vector<float> found = lookup(points);
    CHECK(found[0] == 0.0f);
    CHECK(found[1] == 0.0f);
    CHECK(found[2] == Approx(1.0).margin(0.06));
    for (size_t i = 3; i < found.size(); ++i) {
      INFO(i);
      CHECK(found[i] == Approx(0.5).margin(0.06));
    }
  }
}

TEST_CASE("texture wrap modes") {
  const TemporaryFolder folder;
  write_exr(folder.file("ramp.exr"), ramp(64));
  const auto module = load_image_module(module_file);
  const auto sampler = module->make_texture_sampler({});
  Points points;
  points.add(1.25f, 0.5f, 0.0f);
  const auto lookup = [&](TextureWrap mode) {
    std::vector<float> out(1, -1.0f);
    REQUIRE(sampler
                ->sample({.file = folder.file("ramp.exr"),
                          .channel_count = 1,
                          .s_wrap = mode,
                          .t_wrap = mode},
                         points.view(), out)
                .found);
    return out[0];
  };
  CHECK(lookup(TextureWrap::black) == 0.0f);
  CHECK(lookup(TextureWrap::clamp) == Approx(63.5 / 64).margin(5e-3));
  CHECK(lookup(TextureWrap::periodic) == Approx(0.25).margin(5e-3));
}

TEST_CASE("a grey picture serves as a coloured one") {
  const TemporaryFolder folder;
  Image grey(8, 8);
  grey.add_channel("Y", PixelType::float32, 0.75f);
  write_exr(folder.file("grey.exr"), grey);
  const auto sampler = load_image_module(module_file)->make_texture_sampler({});
  Points points;
  points.add(0.5f, 0.5f, 0.0f);
  std::vector<float> out(3, 0.0f);
  REQUIRE(sampler->sample({.file = folder.file("grey.exr")}, points.view(), out).found);
  for (float value : out) CHECK(value == Approx(0.75));
}

TEST_CASE("a missing texture is reported, from any thread") {
  const auto sampler = load_image_module(module_file)->make_texture_sampler({});
  Points points;
  points.add(0.5f, 0.5f, 0.0f);
  std::vector<TextureResult> results(4);
  std::vector<std::thread> threads;
  for (auto& result : results)
    threads.emplace_back([&] {
      std::vector<float> out(3, 7.0f);
      for (int i = 0; i < 3; ++i)
        result = sampler->sample({.file = "no_such_texture.tx"}, points.view(), out);
      if (out[0] != 7.0f) result.message = "out was touched";
    });
  for (auto& thread : threads) thread.join();
  for (const auto& result : results) {
    CHECK_FALSE(result.found);
    CHECK_THAT(result.message, Catch::Contains("no_such_texture.tx"));
  }
}
