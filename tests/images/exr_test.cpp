#include <catch2/catch.hpp>

#include <signal.h>
#include <sys/resource.h>

#include <bit>
#include <cmath>
#include <fstream>
#include <limits>
#include <random>

#include "base/error.h"
#include "images/exr.h"
#include "temporary_folder.h"

using namespace tessera;

namespace {

Image noise(const PixelRect& display, const PixelRect& data) {
  Image image(display, data);
  std::mt19937 random(7);
  for (const char* name : {"R", "G", "B", "A", "Z", "N.x", "id"}) {
    auto& channel = image.add_channel(name);
    for (float& v : channel.values) v = std::ldexp(float(random()), int(random() % 200) - 130);
  }
  return image;
}

bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](float x, float y) {
    return std::bit_cast<uint32_t>(x) == std::bit_cast<uint32_t>(y);
  });
}

}  // namespace

TEST_CASE("float channels survive a round trip bit for bit") {
  const TemporaryFolder folder;
  Image image = noise({0, 0, 37, 23}, {0, 0, 37, 23});
  image.channels[0].values[3] = std::numeric_limits<float>::infinity();
  image.channels[0].values[4] = std::numeric_limits<float>::quiet_NaN();
  image.channels[0].values[5] = std::numeric_limits<float>::denorm_min();
  image.channels[0].values[6] = -0.0f;
  image.pixel_aspect = 1.5;
  image.metadata = {{"tessera:scene", "a scene"}, {"tessera:options", "spp=16 \"x\"\n"}};
  std::array<float, 16> matrix;
  for (size_t i = 0; i < 16; ++i) matrix[i] = 0.1f + float(i);
  image.matrices["worldToCamera"] = matrix;
  write_exr(folder.file("a.exr"), image);
  CHECK(folder.entries() == 1);

  const Image read = read_exr(folder.file("a.exr"));
  CHECK(read.data_window == image.data_window);
  CHECK(read.display_window == image.display_window);
  CHECK(read.pixel_aspect == 1.5);
  for (const auto& [key, value] : image.metadata) CHECK(read.metadata.at(key) == value);
  CHECK(read.matrices == image.matrices);
  REQUIRE(read.channels.size() == image.channels.size());
  for (const auto& channel : image.channels) {
    INFO(channel.name);
    CHECK(same_bits(read.find_channel(channel.name)->values, channel.values));
  }
}

TEST_CASE("a crop keeps its place in the picture") {
  const TemporaryFolder folder;
  const Image image = noise({0, 0, 640, 480}, {17, 5, 40, 31});
  write_exr(folder.file("crop.exr"), image);
  const Image read = read_exr(folder.file("crop.exr"));
  CHECK(read.display_window == PixelRect{0, 0, 640, 480});
  CHECK(read.data_window == PixelRect{17, 5, 40, 31});
  CHECK(same_bits(read.find_channel("Z")->values, image.find_channel("Z")->values));
}

TEST_CASE("half channels round to nearest and saturate") {
  const TemporaryFolder folder;
  Image image(4, 1);
  image.add_channel("R", PixelType::half).values = {1.0f / 3.0f, 1e30f, -1e30f, 65504.0f};
  write_exr(folder.file("half.exr"), image);
  const auto read = read_exr(folder.file("half.exr"));
  // 1/3 = 1.0101010101(01...)b * 2^-2: ten bits of fraction, rounded down.
  CHECK(read.channels[0].values == std::vector<float>{1365.0f / 4096.0f, 65504, -65504, 65504});
  CHECK(read.channels[0].type == PixelType::half);
}

TEST_CASE("a failed write leaves nothing behind and names the file") {
  const TemporaryFolder folder;
  const Image image = noise({0, 0, 64, 64}, {0, 0, 64, 64});
  const auto refused = [&](const std::string& path) {
    CHECK_THROWS_WITH(write_exr(path, image), Catch::Contains(path));
  };
  refused(folder.file("missing/a.exr"));
  CHECK(folder.entries() == 0);

  std::filesystem::create_directory(folder.file("folder.exr"));
  refused(folder.file("folder.exr"));
  CHECK(folder.entries() == 1);
  refused("/proc/a.exr");

  Image twice = image;
  twice.add_channel("R");
  CHECK_THROWS_AS(write_exr(folder.file("twice.exr"), twice), Error);
  CHECK_THROWS_AS(write_exr(folder.file("empty.exr"), Image(0, 0)), Error);
  CHECK(folder.entries() == 1);
}

TEST_CASE("a disc that fills up leaves the old file as it was") {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.exr");
  Image old(2, 2);
  old.add_channel("R").values = {1, 2, 3, 4};
  write_exr(path, old);

  const auto handler = signal(SIGXFSZ, SIG_IGN);
  rlimit before;
  getrlimit(RLIMIT_FSIZE, &before);
  rlimit small = before;
  small.rlim_cur = 8192;
  setrlimit(RLIMIT_FSIZE, &small);
  std::string message;
  try {
    write_exr(path, noise({0, 0, 256, 256}, {0, 0, 256, 256}));
  } catch (const Error& error) {
    message = error.what();
  }
  setrlimit(RLIMIT_FSIZE, &before);
  signal(SIGXFSZ, handler);

  CHECK_THAT(message, Catch::Contains(path));
  CHECK(folder.entries() == 1);
  CHECK(read_exr(path).channels[0].values == old.channels[0].values);
}

TEST_CASE("files that are no images are refused") {
  const TemporaryFolder folder;
  CHECK_THROWS_AS(read_exr(folder.file("none.exr")), Error);
  std::ofstream(folder.file("text.exr")) << "hello";
  CHECK_THROWS_AS(read_exr(folder.file("text.exr")), Error);

  write_exr(folder.file("a.exr"), noise({0, 0, 50, 50}, {0, 0, 50, 50}));
  std::filesystem::resize_file(folder.file("a.exr"), 9000);
  CHECK_THROWS_AS(read_exr(folder.file("a.exr")), Error);
}
