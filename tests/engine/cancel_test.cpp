// Ctrl-C in the middle of a frame, through the program.

#include <algorithm>

#include <catch2/catch.hpp>
#include <csignal>
#include <fmt/format.h>
#include <unistd.h>

#include "engine/frame_files.h"
#include "images/exr.h"
#include "tests/engine/program.h"
#include "tests/engine/scene_text.h"

using namespace tessera;
using Catch::Matchers::Contains;

namespace {

// Sends Ctrl-C once the first tenth is done. False if the program ended before.
bool interrupt_at_first_tenth(const Process& process) {
  while (process.err_so_far().find('%') == std::string::npos) {
    if (kill(process.id(), 0) != 0) return false;
    usleep(2000);
  }
  return kill(process.id(), SIGINT) == 0;
}

// Renders with options that take a while, and interrupts it.
ProgramResult render_interrupted(std::vector<std::string> arguments,
                                 const TemporaryFolder& folder) {
  arguments.insert(arguments.begin(), tessera_program());
  arguments.insert(arguments.end(), {"--bucket-size", "16", "--spp", "512", "--threads", "1"});
  Process process(arguments, folder);
  REQUIRE(interrupt_at_first_tenth(process));
  return process.wait();
}

}  // namespace

TEST_CASE("Ctrl-C leaves the finished buckets in a valid file, and the batch can go on") {
  const TemporaryFolder folder;
  folder.write("1.rib", sphere_scene(256, 192));
  folder.write("2.rib", sphere_scene(32, 24));
  const std::vector<std::string> arguments{"render", "1.rib", "2.rib",
                                           "-o",     "./",    "--skip-existing"};
  const ProgramResult result = render_interrupted(arguments, folder);
  CHECK(result.exit_code == 130);
  CHECK_THAT(result.out, Contains("interrupted"));
  CHECK(folder.files() == std::vector<std::string>{"1.exr", "1.rib", "2.rib"});

  const Image image = read_exr(folder / "1.exr");
  CHECK(image.width() == 256);
  CHECK(image.height() == 192);
  CHECK_FALSE(is_finished_image(folder / "1.exr"));

  const ProgramResult rest = run_tessera(arguments, folder);
  CHECK(rest.exit_code == 0);
  CHECK_THAT(rest.out, Contains("2 rendered, 0 skipped"));
  CHECK(is_finished_image(folder / "1.exr"));
}

TEST_CASE("an interrupted frame is rendered again whatever its images are called") {
  const TemporaryFolder folder;
  const std::vector<std::string> images{"a.EXR", "b.z", "c.shd", "d.png", "e.JPG", "f.tif"};
  std::string displays;
  for (const std::string& image : images) {
    const char* type = image == "b.z" ? "zfile" : image == "c.shd" ? "shadow" : "file";
    displays += "Display \"+" + image + "\" \"" + type + "\" " +
                (std::string(type) == "file" ? "\"rgb\"\n" : "\"z\"\n");
  }
  folder.write("s.rib", displays + sphere_scene(256, 192));
  const std::vector<std::string> arguments{"render", "s.rib", "--skip-existing"};
  CHECK(render_interrupted(arguments, folder).exit_code == 130);
  for (const std::string& image : images) {
    CAPTURE(image);
    CHECK(folder.has(image));
    CHECK_FALSE(is_finished_image(folder / image));
  }
  CHECK_THAT(run_tessera(arguments, folder).out, Contains("f.tif\n"));
  for (const std::string& image : images) {
    CAPTURE(image);
    CHECK(is_finished_image(folder / image));
    // A part of a file is none. The readers of JPEG and TIFF forgive.
    if (image == "e.JPG" || image == "f.tif") continue;
    const std::string whole = read_text(folder / image);
    folder.write(image, whole.substr(0, whole.size() / 3));
    CHECK_FALSE(is_finished_image(folder / image));
    folder.write(image, whole);
  }
  CHECK_THAT(run_tessera(arguments, folder).out, Contains("skipped"));
}

TEST_CASE("Ctrl-C is seen although standard streams were closed at the start") {
  const TemporaryFolder folder;
  folder.write("s.rib", sphere_scene(256, 192));
  Process process({"/bin/bash", "-c",
                   "exec '" + tessera_program() +
                       "' render s.rib --spp 512 --bucket-size 16 --threads 1 0<&- 2>&-"},
                  folder);
  // Its second thread is the one that watches.
  const std::string threads = fmt::format("/proc/{}/task", process.id());
  const auto count = [&] {
    std::error_code gone;
    return std::distance(std::filesystem::directory_iterator(threads, gone), {});
  };
  while (count() == 1) usleep(2000);
  // Otherwise a descriptor of the watch would be where progress is written.
  for (const int closed : {STDIN_FILENO, STDERR_FILENO})
    CHECK(std::filesystem::read_symlink(fmt::format("/proc/{}/fd/{}", process.id(), closed)) ==
          "/dev/null");
  REQUIRE(kill(process.id(), SIGINT) == 0);
  CHECK(process.wait().exit_code == 130);
}
