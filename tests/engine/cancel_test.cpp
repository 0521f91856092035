// Ctrl-C in the middle of a frame, through the program.

#include <algorithm>

#include <catch2/catch.hpp>
#include <csignal>
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

}  // namespace

TEST_CASE("Ctrl-C leaves the finished buckets in a valid file, and the batch can go on") {
  const TemporaryFolder folder;
  folder.write("1.rib", sphere_scene(256, 192));
  folder.write("2.rib", sphere_scene(32, 24));
  const std::vector<std::string> arguments{"render", "1.rib",           "2.rib",         "-o",
                                           "./",     "--skip-existing", "--bucket-size", "16"};
  std::vector<std::string> slow = arguments;
  slow.insert(slow.begin(), tessera_program());
  slow.insert(slow.end(), {"--spp", "512", "--threads", "1"});
  Process process(slow, folder);
  REQUIRE(interrupt_at_first_tenth(process));
  const ProgramResult result = process.wait();
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
