// Whole frames in every shading mode: the same bits however they are cut into work, faults kept to
// their samples, and maps of cells and of shaded points.

#include <catch2/catch.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "tests/engine/program.h"
#include "tests/engine/differing_values.h"
#include "tests/engine/render_text.h"
#include "tests/engine/scene_text.h"

using namespace tessera;
using Catch::Matchers::Contains;

namespace {

constexpr const char* modes[] = {"aas", "ds", "pixel", "reyes", "sample"};

uint64_t count_of(const FrameResult& frame, std::string_view name) {
  for (const auto& [entry, value] : frame.statistics.counts)
    if (entry == name) return value;
  FAIL("no count " << name);
  return 0;
}

Settings settings_of(const std::string& mode, int threads = 1, int bucket_size = 16) {
  Settings settings;
  settings.shading = mode;
  settings.threads = threads;
  settings.bucket_size = bucket_size;
  return settings;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

/// Motion, defocus and transparency, with patterns that the footprints of cells show in.
std::string patterned_scene() {
  return replaced(everything_scene(), "Surface \"plastic\"", "Surface \"marble\"");
}

/// Three still squares of one colour each under a light of intensity 10, in front of nothing.
std::string squares_scene(const std::string& first, const std::string& second,
                          const std::string& third) {
  return "Format 60 40 1\n"
         "PixelSamples 4 4\n"
         "PixelFilter \"box\" 1 1\n"
         "Projection \"perspective\" \"fov\" [60]\n"
         "Translate 0 0 3\n"
         "WorldBegin\n"
         "LightSource \"ambientlight\" 1 \"intensity\" [10]\n"
         "Surface \"matte\"\n"
         "PointsPolygons [4 4 4] [0 1 4 3  1 2 5 4  3 4 7 6]\n"
         "  \"P\" [-1 -1 0  0.03 -1 0.5  1 -1 0  -1 0 0  0.03 0 0  1 0 0  -1 1 0  0 1 0]\n"
         "  \"uniform color Cs\" [" +
         first + "  " + second + "  " + third + "]\nWorldEnd\n";
}

/// A still square in the middle of the frame, `size` cells or so across.
std::string square_scene(int rate = 1) {
  return "Format 48 40 1\n"
         "PixelSamples 2 2\n"
         "Projection \"orthographic\"\n"
         "ShadingRate " +
         std::to_string(rate) +
         "\nWorldBegin\n"
         "Surface \"constant\"\n"
         "Polygon \"P\" [-0.62 -0.57 1  0.61 -0.57 1  0.61 0.64 1  -0.62 0.64 1]\n"
         "WorldEnd\n";
}

}  // namespace

TEST_CASE("threads and buckets show in no mode's image, cells, map or counts") {
  for (const char* mode : modes) {
    const auto render = [&](int threads, int bucket_size) {
      Settings settings = settings_of(mode, threads, bucket_size);
      settings.aovs = {"rgb", "a", "Oi", "cell"};
      settings.heatmap = "shading";
      return render_text_frame(patterned_scene(), settings);
    };
    const FrameResult reference = render(1, 16);
    CHECK(count_of(reference, "points_shaded") > 1000);
    for (const auto& [threads, bucket_size] :
         {std::pair{2, 16}, {4, 16}, {1, 32}, {3, 61}, {2, 5}}) {
      const FrameResult other = render(threads, bucket_size);
      INFO(mode << " threads " << threads << " bucket size " << bucket_size);
      CHECK(differing_values(reference.image, other.image) == 0);
      for (const char* name : {"points_shaded", "grids_shaded", "light_evaluations"})
        CHECK(count_of(reference, name) == count_of(other, name));
    }
  }
}

TEST_CASE("every mode shows nearly the picture of the reference, from fewer points") {
  const FrameResult reference = render_text_frame(everything_scene(), settings_of("sample"));
  const std::vector<float>& expected = reference.image.find_channel("G")->values;
  std::map<std::string, uint64_t> points;
  for (const char* mode : modes) {
    const FrameResult frame = render_text_frame(everything_scene(), settings_of(mode));
    const std::vector<float>& found = frame.image.find_channel("G")->values;
    double sum = 0;
    for (size_t i = 0; i < found.size(); ++i) {
      const double d = double(found[i]) - double(expected[i]);
      sum += d * d;
    }
    INFO(mode);
    CHECK(std::sqrt(sum / double(found.size())) < 0.04);
    points[mode] = count_of(frame, "points_shaded");
  }
  CHECK(points["aas"] < points["ds"]);
  CHECK(points["ds"] < points["pixel"]);
  CHECK(points["pixel"] < points["sample"]);
}

TEST_CASE("a failed cell costs its own samples and nothing else") {
  const char *first = "0.01 0.05 0.02", *third = "0.03 0.02 0.05";
  const std::string scene_good = squares_scene(first, "0.04 0.01 0.02", third),
                    scene_bad = squares_scene(first, "3e38 0.01 0.02", third),
                    scene_mask = squares_scene("0 0 0", "0.1 0 0", "0 0 0");
  for (const std::string mode : {"aas", "ds", "pixel", "sample"}) {
    INFO(mode);
    const FrameResult good = render_text_frame(scene_good, settings_of(mode));
    const FrameResult bad = render_text_frame(scene_bad, settings_of(mode));
    const Image mask = render_text(scene_mask, settings_of(mode));
    CHECK(count_of(bad, "shade_nonfinite_dropped") > 100);
    CHECK(count_of(good, "shade_nonfinite_dropped") == 0);
    CHECK(count_of(good, "nonfinite_samples_dropped") == 0);
    CHECK(std::ranges::count_if(bad.statistics.warnings, [](const std::string& line) {
            return line.find("\"matte\" gave values that are not finite") != std::string::npos;
          }) == 1);
    double failed_samples = 0;
    size_t changed = 0, shared = 0, wrong = 0, all_failed = 0;
    for (int y = 0; y < 40; ++y)
      for (int x = 0; x < 60; ++x) {
        // Samples of a pixel have equal weights: this is the share of those that fail.
        const double share = double(channel_at(mask, "R", x, y));
        failed_samples += 16 * share;
        all_failed += share > 0.999, shared += share > 0 && share < 0.999;
        for (const char* channel : {"R", "G", "B", "A"}) {
          const float all = channel_at(good.image, channel, x, y),
                      rest = channel_at(bad.image, channel, x, y);
          changed += share == 0 && std::bit_cast<uint32_t>(all) != std::bit_cast<uint32_t>(rest);
          if (share > 0.999) wrong += rest != 0;
          if (share == 0 || share > 0.999) continue;
          const double of_failed =
              std::map<char, double>{{'R', 0.4}, {'G', 0.1}, {'B', 0.2}, {'A', 1.0}}[channel[0]];
          // What is left is the mean of the other samples: no darker, no brighter.
          const double expected = (double(all) - share * of_failed) / (1 - share);
          wrong += !(std::abs(double(rest) - expected) < 1e-5);
        }
      }
    CHECK(double(count_of(bad, "nonfinite_samples_dropped")) == Approx(failed_samples));
    CHECK(changed == 0);
    CHECK(wrong == 0);
    CHECK(shared > 20);
    CHECK(all_failed > 90);
  }
  // Vertices are interpolated between, so in mode reyes they are black.
  const FrameResult reyes = render_text_frame(scene_bad, settings_of("reyes"));
  CHECK(count_of(reyes, "shade_nonfinite_dropped") > 100);
  CHECK(count_of(reyes, "nonfinite_samples_dropped") == 0);
  CHECK(channel_at(reyes.image, "A", 40, 25) == 1);
  CHECK(channel_at(reyes.image, "R", 40, 25) == 0);
}

TEST_CASE("the heat map of shading adds up to the points shaded inside the frame") {
  for (const char* mode : modes) {
    for (const char* filter : {"box:1x1", "gaussian:2x2"}) {
      Settings settings = settings_of(mode);
      settings.heatmap = "shading";
      settings.filter = filter;
      const FrameResult frame = render_text_frame(square_scene(), settings);
      const Image::Channel* map = frame.image.find_channel("heatmap.shading");
      REQUIRE(map);
      const double sum = std::accumulate(map->values.begin(), map->values.end(), 0.0);
      INFO(mode << " " << filter);
      CHECK(sum > 500);
      CHECK(sum == double(count_of(frame, "points_shaded")));
      // Nothing is shaded where nothing is.
      CHECK(channel_at(frame.image, "heatmap.shading", 2, 2) == 0);
      CHECK(channel_at(frame.image, "heatmap.shading", 24, 20) > 0);
      CHECK(frame.statistics.warnings.empty());
    }
  }
}

TEST_CASE("cells of a still frame are squares of the raster, each of one colour") {
  Settings settings = settings_of("ds");
  settings.aovs = {"cell", "a"};
  const FrameResult frame = render_text_frame(square_scene(9), settings);
  using Colour = std::array<float, 3>;
  std::map<std::pair<int, int>, std::set<Colour>> of_cell;
  std::map<Colour, std::set<std::pair<int, int>>> of_colour;
  size_t background = 0;
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 48; ++x) {
      const Colour c{channel_at(frame.image, "cell.R", x, y),
                     channel_at(frame.image, "cell.G", x, y),
                     channel_at(frame.image, "cell.B", x, y)};
      if (channel_at(frame.image, "A", x, y) < 0.9999f) {
        background += c == Colour{0, 0, 0};
        continue;
      }
      of_cell[{x / 3, y / 3}].insert(c);
      of_colour[c].insert({x / 3, y / 3});
      for (const float v : c) CHECK((v >= 0.1f && v <= 1.0f));
    }
  CHECK(background > 300);
  CHECK(of_cell.size() > 50);
  // One grid: a cell, a colour; of two grids at most two, and hardly any two cells alike.
  const size_t grids = size_t(count_of(frame, "grids_shaded"));
  size_t mixed = 0, alike = 0;
  for (const auto& [cell, colours] : of_cell) mixed += colours.size() > grids;
  for (const auto& [colour, cells] : of_colour) alike += cells.size() > 1;
  CHECK(grids == 1);
  CHECK(mixed == 0);
  CHECK(alike == 0);
}

TEST_CASE("cells of a moving frame lie still, those of what is seen at shutter open on top") {
  const std::string camera =
      "Format 48 40 1\n"
      "PixelSamples 4 4\n"
      "Shutter 0 1\n"
      "Projection \"orthographic\"\n"
      "ShadingRate 9\n"
      "WorldBegin\n"
      "Surface \"constant\"\n"
      "Polygon \"P\" [-1.2 -1 5  1.2 -1 5  1.2 1 5  -1.2 1 5]\n";
  // Moves to the right by 30 pixels from x = 4 ... 12.
  const std::string moving =
      "MotionBegin [0 1]\nTranslate 0 0 0\nTranslate 1.5 0 0\nMotionEnd\n"
      "Polygon \"P\" [-1 -1 1  -0.6 -1 1  -0.6 1 1  -1 1 1]\n";
  for (const char* mode : {"ds", "aas"}) {
    Settings settings = settings_of(mode);
    settings.aovs = {"cell"};
    const Image back = render_text(camera + "WorldEnd\n", settings),
                both = render_text(camera + moving + "WorldEnd\n", settings);
    const auto colour = [](const Image& image, int x, int y) {
      return std::array{channel_at(image, "cell.R", x, y), channel_at(image, "cell.G", x, y),
                        channel_at(image, "cell.B", x, y)};
    };
    // One of 16 samples is taken within 1/16 of the shutter, 2 pixels of the way.
    size_t wrong_back = 0, front_over_back = 0, scattered = 0;
    for (int y = 0; y < 39; ++y) {
      for (int x = 15; x < 48; ++x) wrong_back += colour(both, x, y) != colour(back, x, y);
      for (int x = 6; x < 11; ++x) {
        front_over_back += colour(both, x, y) == colour(back, x, y);
        if (std::string_view(mode) == "ds")
          scattered += colour(both, x, y) != colour(both, x / 3 * 3, y / 3 * 3);
      }
    }
    INFO(mode);
    CHECK(wrong_back == 0);
    CHECK(front_over_back == 0);
    CHECK(scattered == 0);
  }
}

TEST_CASE("bad shading modes and rates are refused on the command line, with what is expected") {
  const TemporaryFolder folder;
  folder.write("s.rib", sphere_scene());
  const auto refused = [&](std::vector<std::string> options) {
    std::vector<std::string> arguments{"render", "s.rib", "-o", "out.exr", "--quiet"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProgramResult result = run_tessera(arguments, folder);
    CHECK(result.exit_code != 0);
    CHECK_FALSE(folder.has("out.exr"));
    return result.err;
  };
  for (const char* share : {"0", "1", "-1", "nan", "abc", "0.99995"})
    CHECK_THAT(refused({"--shading", fmt::format("aas:share={}", share)}),
               Contains("above 0 and at most 0.9999") && Contains(fmt::format("\"{}\"", share)));
  CHECK_THAT(refused({"--shading", "aas:unknown=1"}),
             Contains("unknown=1") && Contains("share=NUMBER, lens=NUMBER"));
  CHECK_THAT(refused({"--shading", "ds:x=1"}), Contains("\"ds\"") && Contains("\"x=1\""));
  CHECK_THAT(refused({"--shading", "nothing"}),
             Contains("nothing") && Contains("aas ds pixel reyes sample"));
  for (const char* rate : {"-1", "0", "nan", "abc"})
    CHECK_THAT(refused({"--shading-rate", rate}), Contains("rate") && Contains(rate));
  for (const char* rate : {"-1", "0"}) {
    folder.write("s.rib", replaced(sphere_scene(), "WorldBegin",
                                   fmt::format("ShadingRate {}\nWorldBegin", rate)));
    CHECK_THAT(refused({}), Contains("s.rib:5: ") && Contains("positive shading rate") &&
                                Contains(fmt::format("found {}", rate)));
  }
}
