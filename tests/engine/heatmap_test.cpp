// Maps of what pixels cost, and the samples that the tuple hiders see in whole frames.

#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "engine/heatmap.h"
#include "images/exr.h"
#include "images/image_module.h"
#include "tests/engine/program.h"
#include "tests/engine/render_text.h"
#include "tests/engine/scene_text.h"

using namespace tessera;

namespace {

uint64_t count_of(const Statistics& statistics, std::string_view name) {
  for (const auto& [entry, value] : statistics.counts)
    if (entry == name) return value;
  FAIL("no count " << name);
  return 0;
}

Settings map_settings(const std::string& hider) {
  Settings settings;
  settings.hider = hider;
  settings.heatmap = "tests";
  // No pixel outside the crop is sampled.
  settings.filter = "box:1x1";
  return settings;
}

}  // namespace

TEST_CASE("the heat map of tests adds up to the samples tested") {
  for (const char* hider : {"bbox", "interleave", "accumulate", "interleave:9"})
    for (const bool cropped : {false, true}) {
      Settings settings = map_settings(hider);
      if (cropped) settings.crop = CameraSettings::CropWindow{0.25, 0.8, 0.3, 0.75};
      INFO(hider << " cropped " << cropped);
      const FrameResult frame = render_text_frame(everything_scene(), settings);
      const Image::Channel* map = frame.image.find_channel("heatmap.tests");
      REQUIRE(map);
      CHECK(map->type == PixelType::float32);
      const double sum = std::accumulate(map->values.begin(), map->values.end(), 0.0);
      CHECK(sum == double(count_of(frame.statistics, "samples_tested")));
      REQUIRE(frame.statistics.heatmap.size() == 3);
      CHECK(frame.statistics.heatmap[2].first == "tests_mean");
      CHECK(frame.statistics.heatmap[2].second == Approx(sum / double(map->values.size())));
      CHECK(frame.statistics.warnings.empty());
    }
}

TEST_CASE("a heat map changes no other channel, and there is none unless asked for") {
  Settings settings;
  settings.hider = "bbox";
  const FrameResult plain = render_text_frame(everything_scene(), settings);
  settings.heatmap = "tests";
  const FrameResult mapped = render_text_frame(everything_scene(), settings);
  REQUIRE(mapped.image.channels.size() == plain.image.channels.size() + 1);
  CHECK(plain.statistics.heatmap.empty());
  CHECK(plain.heatmap.empty());
  CHECK_FALSE(plain.statistics.json().contains("heatmap"));
  for (const Image::Channel& channel : plain.image.channels)
    CHECK(mapped.image.find_channel(channel.name)->values == channel.values);
  settings.heatmap = "heat";
  CHECK_THROWS_WITH(render_text_frame(everything_scene(), settings),
                    Catch::Contains("heat map 'heat' is unknown; expected one of tests"));
}

TEST_CASE("an empty heat map says whose doing it is") {
  Settings settings;
  settings.heatmap = "extra";
  const FrameResult frame = render_text_frame(sphere_scene(), settings);
  REQUIRE(frame.statistics.warnings.size() == 1);
  CHECK_THAT(frame.statistics.warnings.front(),
             Catch::Contains("no pixel takes more samples") && !Catch::Contains("hider"));
}

TEST_CASE("a heat map is written beside the image, with its scale") {
  const TemporaryFolder folder;
  folder.write("s.rib", sphere_scene());
  const ProgramResult result = run_tessera({"render", "s.rib", "-o", "out.exr", "--heatmap",
                                            "tests", "--hider", "bbox", "--stats", "s.json"},
                                           folder);
  INFO(result.err);
  REQUIRE(result.exit_code == 0);
  CHECK_THAT(result.err,
             Catch::Contains("heat map tests: min 0, max ") && Catch::Contains("tests per pixel"));
  CHECK_THAT(result.out, Catch::Contains("out.tests.png"));
  const Image exr = read_exr(folder / "out.exr");
  REQUIRE(exr.find_channel("heatmap.tests"));
  const HeatmapScale scale = heatmap_scale(exr, "tests");
  const auto json = nlohmann::json::parse(read_text(folder / "s.json"));
  CHECK(json["heatmap"]["tests_max"] == scale.max);
  CHECK(json["options"]["heatmap"] == "tests");

  // The brightest pixel of the picture is that of the highest value; zero is black.
  const Image png = load_image_module()->read_image(folder / "out.tests.png");
  REQUIRE(png.width() == 32);
  REQUIRE(png.height() == 24);
  const std::vector<float>& values = exr.find_channel("heatmap.tests")->values;
  for (size_t i = 0; i < values.size(); ++i) {
    const float green = png.channels[1].values[i];
    if (values[i] == 0) CHECK(green == 0);
    if (double(values[i]) == scale.max) CHECK(green > 0.98f);
  }
}

TEST_CASE("numbered frames and displays have maps of their own") {
  const TemporaryFolder folder;
  folder.write("a.1.rib", sphere_scene());
  folder.write("d.rib", "Display \"shown.exr\" \"file\" \"rgb\"\n" + sphere_scene());
  REQUIRE(run_tessera({"render", "a.#.rib", "--frames", "1", "-o", "o.####.exr", "--heatmap",
                       "tests", "--hider", "bbox", "--quiet"},
                      folder)
              .exit_code == 0);
  REQUIRE(
      run_tessera({"render", "d.rib", "--heatmap", "tests", "--hider", "bbox"}, folder).exit_code ==
      0);
  CHECK(folder.has("o.0001.tests.png"));
  CHECK(folder.has("shown.tests.png"));
  const Image shown = read_exr(folder / "shown.exr");
  CHECK(shown.find_channel("heatmap.tests"));
  CHECK(shown.find_channel("R"));
}

TEST_CASE("the colours of heat maps get lighter evenly") {
  const auto lightness = [](const std::array<float, 3>& code) {
    double luminance = 0;
    const double weights[] = {0.2126, 0.7152, 0.0722};
    for (size_t c = 0; c < 3; ++c)
      luminance += weights[c] * (code[c] <= 0.04045 ? code[c] / 12.92
                                                    : std::pow((code[c] + 0.055) / 1.055, 2.4));
    return luminance > 0.008856 ? 116 * std::cbrt(luminance) - 16 : 903.3 * luminance;
  };
  CHECK(lightness(heatmap_colour(0)) == 0);
  double last = 0;
  for (int k = 1; k <= 60; ++k) {
    const double now = lightness(heatmap_colour(float(k) / 60));
    CHECK(now - last > 0.8);
    CHECK(now - last < 2.6);  // 98 / 60 = 1.6 on average
    last = now;
  }
  CHECK(heatmap_colour(2.0f) == heatmap_colour(1.0f));
}

TEST_CASE("frames of the tuple hiders do not depend on buckets, threads or the crop") {
  for (const char* hider : {"interleave", "accumulate"}) {
    INFO(hider);
    Settings settings;
    settings.hider = hider;
    const FrameResult reference = render_text_frame(everything_scene(), settings);
    const bool tiles = std::string_view(hider) == "interleave";
    for (const auto& [name, value] : reference.statistics.plan)
      if (name == "samples") CHECK(value == (tiles ? "interleaved:36" : "accumulated:9"));
    settings.bucket_size = 5;
    settings.threads = 3;
    const Image odd = render_text(everything_scene(), settings);
    for (const Image::Channel& channel : reference.image.channels)
      CHECK(odd.find_channel(channel.name)->values == channel.values);
    settings.crop = CameraSettings::CropWindow{0.2625, 0.8125, 0.3, 0.75};
    const Image part = render_text(everything_scene(), settings);
    for (int y = part.data_window.y0; y < part.data_window.y1; ++y)
      for (int x = part.data_window.x0; x < part.data_window.x1; ++x)
        REQUIRE(channel_at(part, "G", x, y) == channel_at(reference.image, "G", x, y));
  }
  Settings settings;
  settings.hider = "interleave:5";
  CHECK_THROWS_WITH(render_text(everything_scene(), settings),
                    Catch::Contains("1, 2, 3, 4, 6, 9, 12, 18, 36"));
}
