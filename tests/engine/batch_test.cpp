// Several frames in one run, through the program.

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "base/error.h"
#include "engine/batch.h"
#include "images/exr.h"
#include "tests/engine/program.h"
#include "tests/engine/scene_text.h"

using namespace tessera;
using Catch::Matchers::Contains;
using Names = std::vector<std::string>;

namespace {

std::string frames_file(int first, int last) {
  std::string text;
  for (int n = first; n <= last; ++n) {
    text += fmt::format("FrameBegin {}\n{}{}FrameEnd\n", n, sphere_camera(), sphere_world(0.2 * n));
  }
  return text;
}

// Share of the frame that is covered, from alpha: tells spheres of different radius apart.
double coverage(const std::string& path) {
  const Image image = read_exr(path);
  double sum = 0;
  for (float a : image.find_channel("A")->values) sum += a;
  return sum / double(image.data_window.pixel_count());
}

}  // namespace

TEST_CASE("numbered names expand to the frames asked for") {
  const auto files = expand_scenes({"a.rib", "s.##.rib"}, std::vector{3, 12});
  REQUIRE(files.size() == 3);
  CHECK(files[0].name == "a.rib");
  CHECK_FALSE(files[0].number);
  CHECK(files[1].name == "s.03.rib");
  CHECK(files[2].name == "s.12.rib");
  CHECK(files[2].number == 12);
  CHECK_THROWS_AS(expand_scenes({"s.##.rib"}, std::nullopt), Error);
}

TEST_CASE("the frames of a file go to numbered images") {
  const TemporaryFolder folder;
  folder.write("s.rib", frames_file(1, 3));
  REQUIRE(run_tessera({"render", "s.rib", "-o", "a.####.exr"}, folder).exit_code == 0);
  REQUIRE(run_tessera({"render", "s.rib", "-o", "b.exr", "--stats", "b.json"}, folder).exit_code ==
          0);
  CHECK(folder.files() == Names{"a.0001.exr", "a.0002.exr", "a.0003.exr", "b.0001.exr",
                                "b.0001.json", "b.0002.exr", "b.0002.json", "b.0003.exr",
                                "b.0003.json", "s.rib"});
  CHECK(coverage(folder / "a.0001.exr") < coverage(folder / "a.0002.exr"));
  CHECK(coverage(folder / "a.0002.exr") < coverage(folder / "a.0003.exr"));
}

TEST_CASE("a file of one frame keeps the name as it is given") {
  const TemporaryFolder folder;
  folder.write("s.rib", frames_file(7, 7));
  REQUIRE(run_tessera({"render", "s.rib", "-o", "a.exr"}, folder).exit_code == 0);
  CHECK(folder.files() == Names{"a.exr", "s.rib"});
}

TEST_CASE("option --frames selects among the frames of a file") {
  const TemporaryFolder folder;
  folder.write("s.rib", frames_file(1, 4));
  REQUIRE(
      run_tessera({"render", "s.rib", "-o", "a.##.exr", "--frames", "2-4x2"}, folder).exit_code ==
      0);
  CHECK(folder.files() == Names{"a.02.exr", "a.04.exr", "s.rib"});
  const ProgramResult none =
      run_tessera({"render", "s.rib", "-o", "a.exr", "--frames", "9"}, folder);
  CHECK(none.exit_code == 1);
  CHECK_THAT(none.err, Contains("none of its 4 frames is among --frames"));
}

TEST_CASE("numbered files render in turn, and a failing one does not stop the rest") {
  const TemporaryFolder folder;
  for (int n : {1, 2, 4}) folder.write(fmt::format("shot.{:04}.rib", n), sphere_scene());
  folder.write("shot.0003.rib", "WorldBegin\nSphere 1 nonsense\nWorldEnd\n");
  const ProgramResult result =
      run_tessera({"render", "shot.####.rib", "--frames", "1-5", "-o", "o.####.exr"}, folder);
  CHECK(result.exit_code == 1);
  CHECK(folder.has("o.0001.exr"));
  CHECK(folder.has("o.0002.exr"));
  CHECK_FALSE(folder.has("o.0003.exr"));
  CHECK(folder.has("o.0004.exr"));
  CHECK_FALSE(folder.has("o.0005.exr"));
  CHECK_THAT(result.out, Contains("3 rendered, 0 skipped, 2 failed"));
  CHECK_THAT(result.err, Contains("shot.0003.rib failed: shot.0003.rib:2"));
  CHECK_THAT(result.err, Contains("shot.0005.rib failed"));
}

TEST_CASE("a failing frame inside a file does not stop the frames after it") {
  const TemporaryFolder folder;
  // The second frame asks for an image in a folder that does not exist.
  std::string text;
  for (const char* image : {"a.exr", "no/such/b.exr", "c.exr"}) {
    text += fmt::format("FrameBegin 1\nDisplay \"{}\" \"file\" \"rgba\"\n{}{}FrameEnd\n", image,
                        sphere_camera(), sphere_world());
  }
  folder.write("s.rib", text);
  const ProgramResult result = run_tessera({"render", "s.rib"}, folder);
  CHECK(result.exit_code == 1);
  CHECK(folder.files() == Names{"a.exr", "c.exr", "s.rib"});
  CHECK_THAT(result.err, Contains("no/such/b.exr"));
}

TEST_CASE("a frame never overwrites another of the same run") {
  const TemporaryFolder folder;
  folder.write("s.rib", frames_file(1, 2));
  const ProgramResult result = run_tessera({"render", "s.rib"}, folder);
  CHECK(result.exit_code == 1);
  CHECK(folder.files() == Names{"s.exr", "s.rib"});
  CHECK_THAT(result.err, Contains("s.exr was already written by an earlier frame"));
}

TEST_CASE("a frame that names a file twice is told so") {
  const TemporaryFolder folder;
  folder.write("s.rib", sphere_scene());
  const ProgramResult twice =
      run_tessera({"render", "s.rib", "-o", "a.png", "--preview", "./a.png"}, folder);
  CHECK(twice.exit_code == 1);
  CHECK_THAT(twice.err, Contains("a.png is named twice by this frame") && !Contains("earlier"));
  folder.write("s.rib",
               "Display \"a\" \"zfile\" \"z\"\nDisplay \"+a\" \"zfile\" \"z\"\n" + sphere_scene());
  CHECK_THAT(run_tessera({"render", "s.rib"}, folder).err,
             Contains("a is named twice by this frame"));
}

TEST_CASE("several files go to numbered images or into a folder") {
  const TemporaryFolder folder;
  folder.write("a.rib", sphere_camera() + sphere_world(0.3));
  folder.write("b.rib", sphere_camera() + sphere_world(0.9));
  folder.write("out/keep", "");
  REQUIRE(run_tessera({"render", "a.rib", "b.rib", "-o", "x.exr"}, folder).exit_code == 0);
  REQUIRE(run_tessera({"render", "a.rib", "b.rib", "-o", "out"}, folder).exit_code == 0);
  CHECK(folder.files() ==
        Names{"a.rib", "b.rib", "out/a.exr", "out/b.exr", "out/keep", "x.0000.exr", "x.0001.exr"});
  CHECK(coverage(folder / "out/a.exr") < coverage(folder / "out/b.exr"));
  CHECK(read_text(folder / "x.0001.exr").size() > 0);
}

TEST_CASE(
    "option --skip-existing renders what is missing, broken or interrupted, and nothing else") {
  const TemporaryFolder folder;
  for (int n = 1; n <= 4; ++n) folder.write(fmt::format("s.{}.rib", n), sphere_scene());
  const std::vector<std::string> arguments{"render", "s.#.rib", "--frames",       "1-4",
                                           "-o",     "o.#.exr", "--skip-existing"};
  REQUIRE(run_tessera(arguments, folder).exit_code == 0);
  const std::string first = read_text(folder / "o.1.exr");

  std::filesystem::remove(folder / "o.2.exr");
  folder.write("o.3.exr", first.substr(0, first.size() / 2));
  Image interrupted = read_exr(folder / "o.4.exr");
  interrupted.metadata["tessera:complete"] = "no, cancelled";
  write_exr(folder / "o.4.exr", interrupted);
  // A finished frame is left out before its scene is read.
  folder.write("s.1.rib", "nonsense");

  const ProgramResult result = run_tessera(arguments, folder);
  CHECK(result.exit_code == 0);
  CHECK_THAT(result.out, Contains("3 rendered, 1 skipped, 0 failed"));
  CHECK(read_text(folder / "o.1.exr") == first);
  for (int n = 2; n <= 4; ++n) CHECK(is_finished_image(folder / fmt::format("o.{}.exr", n)));
  CHECK_THAT(run_tessera(arguments, folder).out, Contains("0 rendered, 4 skipped, 0 failed"));
}

TEST_CASE("option --skip-existing looks at the images that Displays name") {
  const TemporaryFolder folder;
  folder.write("s.rib", "Display \"x.exr\" \"file\" \"rgba\"\n" + sphere_scene());
  REQUIRE(run_tessera({"render", "s.rib", "--skip-existing"}, folder).exit_code == 0);
  CHECK_THAT(run_tessera({"render", "s.rib", "--skip-existing"}, folder).out,
             Contains("x.exr exists, skipped"));
}
