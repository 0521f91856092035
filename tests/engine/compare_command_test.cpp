#include <catch2/catch.hpp>

#include "images/exr.h"
#include "images/file_kinds.h"
#include "tests/engine/program.h"

using namespace tessera;
using Catch::Matchers::Contains;

namespace {

// 4 x 3 pixels of 0.5, one of which is off by `error`: RMSE = error / sqrt(12).
void write_flat(const std::string& path, float error) {
  Image image({0, 0, 4, 3}, {0, 0, 4, 3});
  image.add_channel("R", PixelType::float32, 0.5f).values[1 * 4 + 2] += error;
  write_exr(path, image);
}

void write_grey(const std::string& path, float value) {
  Image image(64, 48);
  for (const char* name : {"R", "G", "B"}) image.add_channel(name, PixelType::float32, value);
  write_exr(path, image);
}

}  // namespace

TEST_CASE("compare measures and exits past the limit") {
  const TemporaryFolder folder;
  write_flat(folder / "a.exr", 0.25f);
  write_flat(folder / "b.exr", 0.0f);
  const ProgramResult result = run_tessera({"compare", "a.exr", "b.exr"}, folder);
  CHECK(result.exit_code == 0);
  CHECK_THAT(result.out, Contains("RMSE     0.0721688"));
  CHECK_THAT(result.out, Contains("largest  0.25 at pixel 2 1, channel R"));

  CHECK(run_tessera({"compare", "a.exr", "b.exr", "--fail-over", "0.0722"}, folder).exit_code == 0);
  CHECK(run_tessera({"compare", "a.exr", "b.exr", "--fail-over", "0.0721"}, folder).exit_code == 1);
  CHECK(run_tessera({"compare", "a.exr", "a.exr", "--fail-over", "0"}, folder).exit_code == 0);
  CHECK_THAT(run_tessera({"compare", "a.exr", "a.exr"}, folder).out, Contains("PSNR     inf"));
}

TEST_CASE("compare measures the channels that it is asked for") {
  const TemporaryFolder folder;
  const auto write = [&](const std::string& name, float grey, float depth) {
    Image image(4, 3);
    for (const char* channel : {"R", "G", "B"})
      image.add_channel(channel, PixelType::float32, grey);
    image.add_channel("z", PixelType::float32, depth);
    write_exr(folder / name, image);
  };
  write("a.exr", 0.75f, 1e20f);
  write("b.exr", 0.5f, 1);
  const auto compare = [&](const std::vector<std::string>& channels) {
    std::vector<std::string> arguments{"compare", "a.exr", "b.exr"};
    arguments.insert(arguments.end(), channels.begin(), channels.end());
    return run_tessera(arguments, folder);
  };
  CHECK_THAT(compare({}).out, Contains("channel z"));
  // 0.25^2 / (0.5^2 + 0.01)
  CHECK_THAT(compare({"--channels", "R,G,B"}).out,
             Contains("RMSE     0.25\n") && Contains("relMSE   0.240385\n") &&
                 Contains("visible") && !Contains("channel z"));
  CHECK_THAT(compare({"--channels", "z"}).out, Contains("channel z") && !Contains("visible"));
  const ProgramResult missing = compare({"--channels", "R,Q"});
  CHECK(missing.exit_code == 1);
  CHECK_THAT(missing.err, Contains("a.exr: no channel Q"));
}

TEST_CASE("compare tells the share of pixels that look different") {
  const TemporaryFolder folder;
  write_grey(folder / "grey.exr", 0.5f);
  write_grey(folder / "almost.exr", 0.5005f);
  write_grey(folder / "dark.exr", 0.1f);
  CHECK_THAT(run_tessera({"compare", "grey.exr", "almost.exr"}, folder).out,
             Contains("visible  0 % of pixels"));
  CHECK_THAT(run_tessera({"compare", "dark.exr", "grey.exr"}, folder).out,
             Contains("visible  100 % of pixels"));
  CHECK_THAT(run_tessera({"compare", "--help"}, folder).out, Contains("perceptual"));

  // Without colours there is nothing to see.
  write_flat(folder / "red.exr", 0);
  CHECK_THAT(run_tessera({"compare", "red.exr", "red.exr"}, folder).out, !Contains("visible"));
}

TEST_CASE("a value that cannot be compared is past every limit") {
  const TemporaryFolder folder;
  write_flat(folder / "a.exr", std::numeric_limits<float>::quiet_NaN());
  write_flat(folder / "b.exr", 0.0f);
  CHECK(run_tessera({"compare", "a.exr", "b.exr"}, folder).exit_code == 0);
  CHECK(run_tessera({"compare", "a.exr", "b.exr", "--fail-over", "1"}, folder).exit_code == 1);
}

TEST_CASE("compare writes the differences") {
  const TemporaryFolder folder;
  write_flat(folder / "a.exr", -0.25f);
  write_flat(folder / "b.exr", 0.0f);
  REQUIRE(run_tessera({"compare", "a.exr", "b.exr", "--diff", "d.exr"}, folder).exit_code == 0);
  REQUIRE(run_tessera({"compare", "a.exr", "b.exr", "--diff", "d.png"}, folder).exit_code == 0);
  const Image difference = read_exr(folder / "d.exr");
  CHECK(difference.find_channel("R")->values[6] == 0.25f);
  CHECK(difference.find_channel("R")->values[0] == 0.0f);
  CHECK(read_text(folder / "d.png").starts_with("\x89PNG"));
}

TEST_CASE("the case of an extension changes nothing, and depth files are EXR under any name") {
  const TemporaryFolder folder;
  write_grey(folder / "grey.exr", 0.2f);
  write_grey(folder / "dark.exr", 0.18f);
  write_grey(folder / "black.exr", 0);
  // Differences to black are the pictures themselves, as PNG.
  for (const std::string picture : {"grey", "dark"})
    REQUIRE(
        run_tessera({"compare", picture + ".exr", "black.exr", "--diff", picture + ".png"}, folder)
            .exit_code == 0);
  const auto copy = [&](const std::string& from, const std::string& to) {
    std::filesystem::copy_file(folder / from, folder / to);
    return to;
  };
  const auto compared = [&](const std::string& a, const std::string& b) {
    const ProgramResult result = run_tessera({"compare", a, b}, folder);
    CHECK(result.exit_code == 0);
    return result.out;
  };
  CHECK(compared(copy("grey.png", "a.PNG"), copy("dark.png", "b.Png")) ==
        compared("grey.png", "dark.png"));
  const std::string exr = compared("grey.exr", "dark.exr");
  CHECK(compared(copy("grey.exr", "a.EXR"), copy("dark.exr", "b.z")) == exr);
  REQUIRE(run_tessera({"compare", "a.EXR", "b.z", "--diff", "d.EXR"}, folder).exit_code == 0);
  CHECK(holds_exr(folder / "d.EXR"));
}

TEST_CASE("images that cannot be compared fail") {
  const TemporaryFolder folder;
  write_flat(folder / "a.exr", 0);
  Image other({0, 0, 5, 3}, {0, 0, 5, 3});
  other.add_channel("R");
  write_exr(folder / "b.exr", other);
  const ProgramResult result = run_tessera({"compare", "a.exr", "b.exr"}, folder);
  CHECK(result.exit_code == 1);
  CHECK_THAT(result.err, Contains("error: "));
  CHECK(run_tessera({"compare", "a.exr", "absent.exr"}, folder).exit_code == 1);
}
