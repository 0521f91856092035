// Options and exit codes, through the program.

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "images/exr.h"
#include "tests/engine/program.h"
#include "tests/engine/scene_text.h"

using namespace tessera;
using Catch::Matchers::Contains;

TEST_CASE("a scene becomes an image of its format") {
  const TemporaryFolder folder;
  folder.write("s.rib", sphere_scene(32, 24));
  const ProgramResult result = run_tessera({"render", "s.rib", "-o", "out.exr"}, folder);
  REQUIRE(result.exit_code == 0);
  // Progress in plain lines, and nothing to complain of.
  CHECK_THAT(result.err, Contains("s.rib: 100%"));
  CHECK_THAT(result.err, !Contains("warning") && !Contains("\r"));
  CHECK_THAT(result.out, Contains("s.rib -> out.exr"));
  CHECK(folder.files() == std::vector<std::string>{"out.exr", "s.rib"});

  const Image image = read_exr(folder / "out.exr");
  CHECK(image.width() == 32);
  CHECK(image.height() == 24);
  REQUIRE(image.find_channel("R"));
  REQUIRE(image.find_channel("A"));
  // The middle of the sphere is covered, the corner is not.
  CHECK(image.find_channel("A")->values[12 * 32 + 16] == 1.0f);
  CHECK(image.find_channel("A")->values[0] == 0.0f);
}

TEST_CASE("without -o the scene's Displays are written, or an image named after the scene") {
  const TemporaryFolder folder;
  folder.write("plain.rib", sphere_scene());
  folder.write("named.rib",
               "Display \"beauty.exr\" \"file\" \"rgba\"\n"
               "Display \"+depth.exr\" \"file\" \"z\"\n"
               "Display \"+window\" \"framebuffer\" \"rgb\"\n" +
                   sphere_scene());
  REQUIRE(run_tessera({"render", "plain.rib", "named.rib"}, folder).exit_code == 0);
  CHECK(folder.files() ==
        std::vector<std::string>{"beauty.exr", "depth.exr", "named.rib", "plain.exr", "plain.rib"});
  CHECK(read_exr(folder / "depth.exr").find_channel("Z"));
  CHECK_FALSE(read_exr(folder / "depth.exr").find_channel("R"));
}

TEST_CASE("options override the scene") {
  const TemporaryFolder folder;
  folder.write("s.rib", "CropWindow 0 1 0 1\n" + sphere_scene(32, 24));
  const ProgramResult result = run_tessera(
      {"render", "s.rib",    "-o",      "out.exr", "--format", "64x40",  "--crop",
       "0.25",   "0.5",      "0.5",     "1",       "--spp",    "9",      "--shading-rate",
       "4",      "--filter", "box:1x1", "--hider", "bbox",     "--seed", "7",
       "--aov",  "N,id",     "--stats", "s.json",  "--quiet"},
      folder);
  REQUIRE(result.exit_code == 0);
  CHECK(result.out == "");
  CHECK(result.err == "");
  const Image image = read_exr(folder / "out.exr");
  CHECK(image.display_window == PixelRect{0, 0, 64, 40});
  CHECK(image.data_window == PixelRect{16, 20, 32, 40});
  CHECK(image.find_channel("N.x"));
  CHECK_FALSE(image.find_channel("st.s"));

  const nlohmann::json plan = nlohmann::json::parse(read_text(folder / "s.json"))["plan"];
  CHECK(plan["samples_per_pixel"] == "9");
  CHECK(plan["hider"] == "bbox");
  CHECK(plan["filter"] == "box:1x1");
}

TEST_CASE("a cropped frame has the pixels of the whole one") {
  const TemporaryFolder folder;
  folder.write("s.rib", everything_scene());
  REQUIRE(run_tessera({"render", "s.rib", "-o", "whole.exr"}, folder).exit_code == 0);
  REQUIRE(run_tessera({"render", "s.rib", "-o", "crop.exr", "--crop", "0.25", "0.75", "0.2", "0.8"},
                      folder)
              .exit_code == 0);
  const Image whole = read_exr(folder / "whole.exr"), crop = read_exr(folder / "crop.exr");
  const PixelRect& window = crop.data_window;
  REQUIRE(window == PixelRect{20, 12, 60, 48});
  // Two pixels from the crop's border the filter, 3 pixels wide, sees no sample beyond it.
  size_t different = 0;
  for (const Image::Channel& channel : crop.channels) {
    const std::vector<float>& all = whole.find_channel(channel.name)->values;
    for (int y = window.y0 + 2; y < window.y1 - 2; ++y) {
      for (int x = window.x0 + 2; x < window.x1 - 2; ++x) {
        const size_t i = size_t(y - window.y0) * size_t(window.width()) + size_t(x - window.x0);
        different += channel.values[i] != all[size_t(y) * 80 + size_t(x)];
      }
    }
  }
  CHECK(different == 0);
}

TEST_CASE("what is wrong with a command line is said, with exit code 2") {
  const TemporaryFolder folder;
  folder.write("s.rib", sphere_scene());
  struct Case {
    std::vector<std::string> arguments;
    std::string message;
  };
  const std::vector<Case> cases = {
      {{}, "subcommand"},
      {{"paint"}, "paint"},
      {{"render", "s.rib", "--frobnicate"}, "--frobnicate"},
      {{"render", "s.rib", "--spp", "0"}, "--spp"},
      {{"render", "s.rib", "--spp", "many"}, "--spp"},
      {{"render", "s.rib", "--hider", "zbuffer"}, "there is"},
      {{"render", "s.rib", "--shading", "x"}, "there is"},
      {{"render", "s.rib", "--filter", "x"}, "there is"},
      {{"render", "s.rib", "--aov", "N,x"}, "there is"},
      {{"render", "s.rib", "--heatmap", "x"}, "no heat map 'x'; there is tests"},
      {{"render", "s.rib", "--crop", "0", "1", "0"}, "--crop"},
      {{"render", "s.rib", "--crop", "0.5", "0.5", "0", "1"}, "X0 < X1"},
      {{"render", "s.rib", "--crop", "0", "1", "0", "2"}, "--crop"},
      {{"render", "s.rib", "--format", "640"}, "WIDTHxHEIGHT"},
      {{"render", "s.rib", "--format", "0x10"}, "WIDTHxHEIGHT"},
      {{"render", "s.rib", "--threads", "-1"}, "--threads"},
      {{"render", "s.rib", "--shading-rate", "nan"}, "--shading-rate"},
      {{"render", "s.rib", "--dicing-rate", "0"}, "--dicing-rate"},
      {{"render", "s.rib", "--dicing-rate", "-1"}, "--dicing-rate"},
      {{"render", "s.rib", "--dicing-rate", "nan"}, "'nan': expected a number from"},
      {{"render", "s.rib", "--dicing-rate", "fine"}, "--dicing-rate"},
      {{"render", "s.rib", "--motion-factor", "-1"}, "--motion-factor"},
      {{"render", "s.rib", "--focus-factor", "nan"}, "--focus-factor"},
      {{"render", "s.rib", "--ray-dicing-rate", "0"}, "--ray-dicing-rate"},
      {{"render", "s.rib", "--ray-dicing-rate", "nan"}, "'nan': expected a number from"},
      {{"render", "s.rib", "--extra-samples", "-1"}, "--extra-samples"},
      {{"render", "s.rib", "--extra-samples", "5000"}, "--extra-samples"},
      {{"render", "s.rib", "--reconstruct", "x"}, "no reconstruction 'x'; there is aaf"},
      {{"render", "s.rib", "--reconstruct", ""}, "there is"},
      {{"render", "s.rib", "--reconstruct", "filter:3"}, "there is"},
      {{"render", "s.rib", "--memory", "0"}, "--memory"},
      {{"render", "s.rib", "--frames", "3-1"}, "A <= B"},
      {{"render", "s.####.rib", "-o", "x.exr"}, "--frames"},
      {{"render", "s.rib", "--quiet", "--verbose"}, "--verbose"},
      {{"info"}, "scene"},
      {{"compare", "a.exr"}, "b"},
  };
  for (const Case& c : cases) {
    const ProgramResult result = run_tessera(c.arguments, folder);
    INFO(result.err);
    CHECK(result.exit_code == 2);
    CHECK_THAT(result.err, Contains("error: ") && Contains(c.message));
  }
  CHECK(folder.files() == std::vector<std::string>{"s.rib"});
}

TEST_CASE("help names every choice") {
  const TemporaryFolder folder;
  const ProgramResult result = run_tessera({"render", "--help"}, folder);
  CHECK(result.exit_code == 0);
  for (const char* word : {"--spp",
                           "--shading-rate",
                           "--crop",
                           "--threads",
                           "--hider",
                           "--shading",
                           "--seed",
                           "--memory",
                           "--stats",
                           "--verbose",
                           "--skip-existing",
                           "bbox",
                           "auto",
                           "shear",
                           "reyes",
                           "gaussian",
                           "motion",
                           "--heatmap",
                           "interleave",
                           "accumulate",
                           "--dicing-rate",
                           "--motion-factor",
                           "--focus-factor",
                           "--reconstruct",
                           "wiener",
                           "--extra-samples",
                           "--ray-dicing-rate"}) {
    CHECK_THAT(result.out, Contains(word));
  }
}

TEST_CASE("options of rays and of filters for distribution effects are in force") {
  const TemporaryFolder folder;
  folder.write("s.rib", rays_scene());
  const auto statistics_of = [&](std::vector<std::string> options) {
    std::vector<std::string> arguments{"render", "s.rib", "--stats", "s.json", "--quiet"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProgramResult result = run_tessera(arguments, folder);
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
    return nlohmann::json::parse(read_text(folder / "s.json"));
  };
  const auto defaults = statistics_of({});
  CHECK(defaults["plan"]["reconstruct"] == "wiener");
  CHECK(defaults["plan"]["extra_samples"] == "100");
  CHECK(defaults["counts"]["extra_samples"] > 0);
  CHECK_FALSE(defaults["options"].contains("ray_dicing_rate"));

  const auto filtered =
      statistics_of({"--reconstruct", "maaf:3", "--extra-samples", "0", "--ray-dicing-rate", "2"});
  CHECK(filtered["plan"]["reconstruct"] == "maaf:3");
  CHECK(filtered["plan"]["extra_samples"] == "0");
  CHECK(filtered["counts"]["extra_samples"] == 0);
  CHECK(filtered["options"]["ray_dicing_rate"] == "2");
  CHECK(filtered["memory_bytes"]["ray_bytes"] > defaults["memory_bytes"]["ray_bytes"]);

  // Nobody filters: more samples would be of no use.
  const auto bare = statistics_of({"--reconstruct", "filter", "--extra-samples", "50"});
  CHECK(bare["plan"]["reconstruct"] == "filter");
  CHECK(bare["plan"]["extra_samples"] == "0");
  CHECK(bare["counts"]["extra_samples"] == 0);
}

TEST_CASE("a bad scene names its line, fails and leaves no file") {
  const TemporaryFolder folder;
  folder.write("bad.rib", "Format 32 24 1\nWorldBegin\nSphere 1 -1 \"x\" 360\nWorldEnd\n");
  folder.write("cut.rib", "WorldBegin\nSphere 1 -1 1 360\n");
  folder.write("none.rib", "Format 32 24 1\n");
  folder.write("rate.rib", "Format 32 24 1\nShadingRate -1\n" + sphere_world());
  folder.write("dice.rib", "WorldBegin\nAttribute \"dice\" \"rate\" [-1]\nWorldEnd\n");
  folder.write("blur.rib", "GeometricApproximation \"focusfactor\" -1\n" + sphere_world());
  folder.write("noise.rib", std::string("\x00\xff\x13garbage\x80", 11));
  const auto failing = [&](const std::string& scene) {
    const ProgramResult result =
        run_tessera({"render", scene, "-o", "out.exr", "--stats", "s.json"}, folder);
    INFO(scene);
    CHECK(result.exit_code == 1);
    CHECK_THAT(result.err, Contains("error: " + scene));
    CHECK(run_tessera({"info", scene}, folder).exit_code == 1);
    return result.err;
  };
  CHECK_THAT(failing("bad.rib"), Contains("bad.rib:3: "));
  CHECK_THAT(failing("rate.rib"), Contains("rate.rib:2: ") && Contains("-1"));
  CHECK_THAT(failing("dice.rib"), Contains("dice.rib:2: ") && Contains("-1"));
  CHECK_THAT(failing("blur.rib"), Contains("blur.rib:1: ") && Contains("-1"));
  failing("cut.rib");
  CHECK_THAT(failing("none.rib"), Contains("WorldBegin"));
  failing("noise.rib");
  failing("absent.rib");
  CHECK(folder.files() == std::vector<std::string>{"bad.rib", "blur.rib", "cut.rib", "dice.rib",
                                                   "noise.rib", "none.rib", "rate.rib"});
}

TEST_CASE("an output that cannot be written is refused before rendering") {
  const TemporaryFolder folder;
  folder.write("s.rib", sphere_scene());
  const ProgramResult result = run_tessera({"render", "s.rib", "-o", "no/such/out.exr"}, folder);
  CHECK(result.exit_code == 1);
  CHECK_THAT(result.err, Contains("error: cannot write no/such/out.exr"));
}

TEST_CASE("Displays of no mode and names of no format are refused before rendering") {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& displays, std::vector<std::string> options,
                           const char* message) {
    folder.write("s.rib", displays + sphere_scene());
    options.insert(options.begin(), {"render", "s.rib"});
    const ProgramResult result = run_tessera(options, folder);
    CHECK(result.exit_code == 1);
    CHECK_THAT(result.err, Contains(message) && !Contains("%"));
    CHECK(folder.files() == std::vector<std::string>{"s.rib"});
  };
  const std::string sound = "Display \"a.exr\" \"file\" \"rgb\"\n";
  refused(sound + "Display \"+b.exr\" \"file\" \"rgbq\"\n", {}, "s.rib:2: Display mode 'rgbq'");
  refused("Display \"b.exr\" \"file\" \"\"\n", {}, "s.rib:1: Display mode ''");
  refused(sound + "Display \"+b.gif\" \"file\" \"rgb\"\n", {}, "cannot write b.gif");
  refused("", {"-o", "b"}, "cannot write b: unknown format");
  refused("", {"-o", "a.exr", "--preview", "b.bmp"}, "cannot write b.bmp: unknown format");
  // What is not used is not looked at.
  folder.write("s.rib", "Display \"w\" \"framebuffer\" \"rgbq\"\n" + sphere_scene());
  CHECK(run_tessera({"render", "s.rib"}, folder).exit_code == 0);
  folder.write("s.rib", "Display \"w\" \"file\" \"rgbq\"\n" + sphere_scene());
  CHECK(run_tessera({"render", "s.rib", "-o", "a.exr"}, folder).exit_code == 0);
}

TEST_CASE("info tells what a scene holds and its plan, and renders nothing") {
  const TemporaryFolder folder;
  folder.write("s.rib", everything_scene());
  const ProgramResult result = run_tessera({"info", "s.rib"}, folder);
  REQUIRE(result.exit_code == 0);
  for (const char* text : {"80 x 60", "4 (4 distinct shapes, 1 moving)", "1 sphere",
                           "1 catmull-clark mesh: 6 faces, 8 control points", "pointlight",
                           "plastic", "checker", "camera motion", "motion               yes",
                           "lens                 yes", "transparency         yes"}) {
    CHECK_THAT(result.out, Contains(text));
  }
  CHECK(folder.files() == std::vector<std::string>{"s.rib"});

  folder.write("still.rib", sphere_scene());
  const ProgramResult still = run_tessera({"info", "still.rib"}, folder);
  for (const char* need : {"motion", "lens", "transparency", "displacement", "textures"}) {
    CHECK_THAT(still.out, Contains(fmt::format("    {:<20} no", need)));
  }
}
