// The example scenes, and scenes by other people where they lie beside the checkout.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/engine/render_text.h"

using namespace tessera;
namespace fs = std::filesystem;

namespace {

std::vector<fs::path> rib_files(const fs::path& folder) {
  std::vector<fs::path> files;
  if (!fs::is_directory(folder)) return files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".rib") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

Settings small_frame() {
  Settings settings;
  settings.x_resolution = 96, settings.y_resolution = 54;
  settings.samples_per_pixel = 4;
  return settings;
}

FrameResult render_last_frame(const fs::path& file, const Settings& settings) {
  Diagnostics diagnostics;
  SceneCollector sink;
  read_rib(file.string(), sink, diagnostics);
  REQUIRE(!sink.scenes.empty());
  return render_frame(*sink.scenes.back(), settings, diagnostics);
}

void check_pixels(const FrameResult& frame) {
  double alpha = 0;
  for (const Image::Channel& channel : frame.image.channels) {
    const bool finite = std::all_of(channel.values.begin(), channel.values.end(),
                                    [](float v) { return std::isfinite(v); });
    INFO("channel " << channel.name);
    CHECK(finite);
    if (channel.name == "A")
      for (float a : channel.values) alpha += a;
  }
  CHECK(alpha > 0.01 * double(frame.image.data_window.pixel_count()));
}

// Pixels that are not wholly covered and cannot be reached from the border of the image through
// such pixels: holes.
int count_holes(const Image& image) {
  const std::vector<float>& alpha = image.find_channel("A")->values;
  const int width = image.width(), height = image.height();
  std::vector<char> open(alpha.size());
  // Full coverage is a ratio of two sums in float.
  for (size_t k = 0; k < alpha.size(); ++k) open[k] = alpha[k] < 0.99999f;
  std::vector<std::pair<int, int>> stack;
  const auto visit = [&](int x, int y) {
    if (x < 0 || y < 0 || x >= width || y >= height || !open[size_t(y * width + x)]) return;
    open[size_t(y * width + x)] = 0;
    stack.emplace_back(x, y);
  };
  for (int x = 0; x < width; ++x) visit(x, 0), visit(x, height - 1);
  for (int y = 0; y < height; ++y) visit(0, y), visit(width - 1, y);
  while (!stack.empty()) {
    const auto [x, y] = stack.back();
    stack.pop_back();
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) visit(x + dx, y + dy);
  }
  return int(std::count(open.begin(), open.end(), 1));
}

}  // namespace

TEST_CASE("every example scene renders") {
  const auto files = rib_files(fs::path(TESSERA_SOURCE_DIR) / "scenes/examples");
  REQUIRE(files.size() >= 8);
  for (const fs::path& file : files) {
    INFO(file.filename());
    check_pixels(render_last_frame(file, small_frame()));
  }
}

TEST_CASE("scenes by other people render") {
  for (const fs::path& file : rib_files(fs::path(TESSERA_SOURCE_DIR) / "../shared/rib")) {
    if (file.filename() == "statuemodel.rib") continue;  // an archive without a world
    INFO(file.filename());
    check_pixels(render_last_frame(file, small_frame()));
  }
}

TEST_CASE("a closed displaced surface has no pin-hole") {
  const std::string cube =
      R"(SubdivisionMesh "catmull-clark" [4 4 4 4 4 4]
           [0 2 3 1  4 5 7 6  0 1 5 4  2 6 7 3  0 4 6 2  1 3 7 5]
           "P" [-1 -1 -1  1 -1 -1  -1 1 -1  1 1 -1  -1 -1 1  1 -1 1  -1 1 1  1 1 1])";
  const std::string sphere = "Sphere 0.8 -0.8 0.8 360";
  for (const std::string& shape : {cube, sphere}) {
    for (const char* rate : {"0.3", "1", "7"}) {
      const Image image = render_text(fmt::format(R"(
        Format 160 160 1  PixelSamples 4 4  PixelFilter "box" 1 1  ShadingRate {}
        Projection "perspective" "fov" [40]
        WorldBegin
          Translate 0 0 3.6
          Rotate 33 1 2 0.5
          Attribute "displacementbound" "float sphere" [0.3]
          Displacement "bumpy" "float amplitude" [0.25] "float frequency" [4]
          Surface "constant"
          {}
        WorldEnd)", rate, shape));
      INFO(shape << " at shading rate " << rate);
      CHECK(count_holes(image) == 0);
    }
  }
}

TEST_CASE("a crop has the pixels of the whole frame") {
  const fs::path file = fs::path(TESSERA_SOURCE_DIR) / "scenes/examples/film_frame.rib";
  Settings settings = small_frame();
  const Image whole = render_last_frame(file, settings).image;
  settings.crop = CameraSettings::CropWindow{0.25, 0.75, 0.5, 1};
  const Image crop = render_last_frame(file, settings).image;
  REQUIRE(crop.data_window == PixelRect{24, 27, 72, 54});
  for (const Image::Channel& channel : crop.channels)
    for (int y = 27; y < 54; ++y)
      for (int x = 24; x < 72; ++x)
        if (channel_at(whole, channel.name, x, y) != channel_at(crop, channel.name, x, y))
          FAIL(channel.name << " differs at " << x << ", " << y);
}
