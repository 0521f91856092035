// Frames that are rendered to an error or within a time.

#include <cmath>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "images/exr.h"
#include "tests/engine/differing_values.h"
#include "tests/engine/program.h"
#include "tests/engine/render_text.h"
#include "tests/engine/scene_text.h"

using namespace tessera;
using Catch::Matchers::Contains;

namespace {

double number(const FrameResult& frame, std::string_view name) {
  for (const auto& [entry, value] : frame.statistics.accuracy.numbers)
    if (entry == name) return value;
  throw Error(fmt::format("no number {}", name));
}

std::string word(const FrameResult& frame, std::string_view name) {
  for (const auto& [entry, value] : frame.statistics.accuracy.words)
    if (entry == name) return value;
  throw Error(fmt::format("no word {}", name));
}

// Root of the relative mean square difference of R, G and B.
double relative_error(const Image& image, const Image& reference) {
  double sum = 0;
  size_t count = 0;
  for (const char* name : {"R", "G", "B"}) {
    const std::vector<float>& a = image.find_channel(name)->values;
    const std::vector<float>& b = reference.find_channel(name)->values;
    for (size_t p = 0; p < a.size(); ++p, ++count) {
      const double d = double(a[p]) - double(b[p]);
      sum += d * d / (double(b[p]) * double(b[p]) + 0.01);
    }
  }
  return std::sqrt(sum / double(count));
}

Settings to_error(double error) {
  Settings settings;
  settings.error = error;
  return settings;
}

// A ball that moves across most of the frame, on black.
std::string moving_ball(const std::string& options = "") {
  return "Format 64 48 1\nShutter 0 1\n" + options +
         "Projection \"perspective\" \"fov\" [40]\nTranslate 0 0 4\n"
         "WorldBegin\n"
         "LightSource \"ambientlight\" 1 \"intensity\" [0.8]\n"
         "Surface \"constant\"\n"
         "AttributeBegin\n"
         "MotionBegin [0 1]\nTranslate -1 0 0\nTranslate 1 0.2 0\nMotionEnd\n"
         "Color [0.9 0.6 0.3]\nSphere 0.5 -0.5 0.5 360\n"
         "AttributeEnd\nWorldEnd\n";
}

}  // namespace

TEST_CASE("the error that is estimated is the error that there is") {
  Settings many;
  many.samples_per_pixel = 1024;
  many.seed = 99;
  const Image reference = render_text(moving_ball(), many);
  for (const double error : {0.05, 0.02, 0.01}) {
    const FrameResult frame = render_text_frame(moving_ball(), to_error(error));
    CHECK(number(frame, "error_estimated") <= error);
    CHECK(word(frame, "error_target_reached") == "yes");
    CHECK(relative_error(frame.image, reference) ==
          Approx(number(frame, "error_estimated")).epsilon(0.2));
    CHECK(frame.statistics.warnings.empty());
  }
}

TEST_CASE("samples go where the noise is") {
  const FrameResult frame = render_text_frame(moving_ball(), to_error(0.01));
  CHECK(number(frame, "spp_min") < 0.5 * number(frame, "spp_mean"));
  CHECK(number(frame, "spp_max") > 1.5 * number(frame, "spp_mean"));
  Settings even;
  even.samples_per_pixel = int(number(frame, "spp_mean") + 1);
  Settings many;
  many.samples_per_pixel = 1024;
  many.seed = 99;
  const Image reference = render_text(moving_ball(), many);
  CHECK(relative_error(frame.image, reference) <
        relative_error(render_text(moving_ball(), even), reference));
}

TEST_CASE("threads and bucket size do not show in a frame that is rendered to an error") {
  for (const std::string& scene : {everything_scene(), rays_scene()}) {
    Settings settings = to_error(0.012);
    settings.max_samples = 48;
    settings.aovs = {"N", "id"};
    settings.threads = 1;
    const FrameResult reference = render_text_frame(scene, settings);
    REQUIRE(number(reference, "passes") >= 4);
    REQUIRE(number(reference, "spp_min") < number(reference, "spp_max"));
    for (const auto& [threads, bucket] : {std::pair{3, 32}, {1, 7}, {2, 64}}) {
      settings.threads = threads;
      settings.bucket_size = bucket;
      const FrameResult frame = render_text_frame(scene, settings);
      CHECK(differing_values(frame.image, reference.image) == 0);
      CHECK(number(frame, "error_estimated") == number(reference, "error_estimated"));
    }
  }
}

TEST_CASE("an error out of reach stops at the limit of samples and says so") {
  Settings settings = to_error(1e-5);
  settings.max_samples = 24;
  const FrameResult frame = render_text_frame(moving_ball(), settings);
  CHECK(word(frame, "error_target_reached") == "no");
  CHECK(number(frame, "spp_mean") <= 24);
  CHECK(number(frame, "spp_mean") > 16);
  REQUIRE(frame.statistics.warnings.size() == 1);
  CHECK_THAT(frame.statistics.warnings.front(), Contains("is not reached"));
}

TEST_CASE("frames of nothing and of black are done at once") {
  const std::string camera = "Format 16 12 1\nProjection \"perspective\" \"fov\" [40]\n";
  for (const std::string& world :
       {std::string("WorldBegin\nWorldEnd\n"),
        std::string("WorldBegin\nSurface \"constant\"\nColor [0 0 0]\nTranslate 0 0 3\n"
                    "Sphere 9 -9 9 360\nWorldEnd\n")}) {
    const FrameResult frame = render_text_frame(camera + world, to_error(1e-3));
    CHECK(number(frame, "error_estimated") == 0.0);
    CHECK(number(frame, "passes") == 2.0);
    CHECK(word(frame, "error_target_reached") == "yes");
    CHECK(channel_at(frame.image, "R", 3, 3) == 0.0f);
  }
}

TEST_CASE("a gamma applies to the mean of the passes") {
  const FrameResult linear = render_text_frame(moving_ball(), to_error(0.03));
  const FrameResult encoded = render_text_frame(moving_ball("Exposure 1 2.2\n"), to_error(0.03));
  CHECK_FALSE(linear.display_encoded);
  CHECK(encoded.display_encoded);
  CHECK(number(linear, "error_estimated") == number(encoded, "error_estimated"));
  for (int x = 0; x < 64; ++x)
    CHECK(channel_at(encoded.image, "G", x, 24) ==
          Approx(std::pow(channel_at(linear.image, "G", x, 24), 1 / 2.2)).margin(1e-6));
}

TEST_CASE("a crop is rendered to its own error") {
  Settings settings = to_error(0.02);
  settings.crop = CameraSettings::CropWindow{0.25, 0.5, 0.5, 0.75};
  const FrameResult frame = render_text_frame(moving_ball(), settings);
  CHECK(frame.image.width() == 16);
  CHECK(frame.image.height() == 12);
  CHECK(number(frame, "error_estimated") <= 0.02);
}

TEST_CASE("a frame within a time can be repeated") {
  Settings settings;
  settings.time_s = 0.15;
  settings.seed = 5;
  const FrameResult timed = render_text_frame(moving_ball(), settings);
  const std::string repeat = word(timed, "repeat");
  const TemporaryFolder folder;
  folder.write("s.rib", moving_ball());
  std::vector<std::string> arguments{"render", "s.rib", "-o", "out.exr", "--quiet"};
  for (size_t start = 0; start < repeat.size();) {
    const size_t end = std::min(repeat.find(' ', start), repeat.size());
    arguments.push_back(repeat.substr(start, end - start));
    start = end + 1;
  }
  const ProgramResult result = run_tessera(arguments, folder);
  INFO(result.err);
  REQUIRE(result.exit_code == 0);
  CHECK(differing_values(read_exr(folder / "out.exr"), timed.image) == 0);
}

TEST_CASE("a frame with time for more than the limit of samples says so") {
  Settings settings;
  settings.time_s = 1000;
  settings.max_samples = 6;
  const FrameResult frame = render_text_frame(moving_ball(), settings);
  CHECK(number(frame, "spp_mean") <= 6);
  REQUIRE(frame.statistics.warnings.size() == 1);
  CHECK_THAT(frame.statistics.warnings.front(), Contains("limit of 6 samples"));
}

TEST_CASE("the program tells what was reached, and refuses targets that make no sense") {
  const TemporaryFolder folder;
  folder.write("s.rib", moving_ball());
  const ProgramResult done = run_tessera(
      {"render", "s.rib", "-o", "o.exr", "--error", "1e-4", "--max-spp", "12", "--stats", "s.json"},
      folder);
  CHECK(done.exit_code == 0);
  CHECK_THAT(done.err, Contains("warning") && Contains("is not reached"));
  const auto json = nlohmann::json::parse(read_text(folder / "s.json"));
  CHECK(json["accuracy"]["error_target_reached"] == "no");
  CHECK(json["accuracy"]["error_target"] == 1e-4);

  for (const std::vector<std::string>& bad :
       std::vector<std::vector<std::string>>{{"--error", "0"},
                                             {"--error", "-0.1"},
                                             {"--error", "nan"},
                                             {"--error", "x"},
                                             {"--time", "0"},
                                             {"--time", "-2"},
                                             {"--time", "nan"},
                                             {"--max-spp", "64"},
                                             {"--error", "0.1", "--max-spp", "1"},
                                             {"--error", "0.1", "--spp", "16"},
                                             {"--time", "1", "--spp", "16"},
                                             {"--rounds", "4,0"},
                                             {"--passes", "4,0"},
                                             {"--passes", "4,1.5"},
                                             {"--passes", "4", "--spp", "4"},
                                             {"--passes", "4", "--rounds", "4"},
                                             {"--rounds", "4", "--error", "0.1"}}) {
    std::vector<std::string> arguments{"render", "s.rib", "-o", "o.exr"};
    arguments.insert(arguments.end(), bad.begin(), bad.end());
    const ProgramResult result = run_tessera(arguments, folder);
    CAPTURE(bad, result.err);
    CHECK(result.exit_code == 2);
    CHECK_THAT(result.err, Contains("error: "));
  }
}
