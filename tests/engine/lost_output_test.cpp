// Standard streams that are full, closed or read by nobody, through the program.

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "engine/frame_files.h"
#include "tests/engine/program.h"
#include "tests/engine/scene_text.h"

using namespace tessera;
using Catch::Matchers::Contains;

namespace {

// Runs the renderer by a shell, with what the shell is to do with its streams.
ProgramResult run_redirected(const std::string& arguments, const std::string& redirection,
                             const TemporaryFolder& folder) {
  const std::string line = fmt::format("'{}' {} {}", tessera_program(), arguments, redirection);
  return Process({"/bin/bash", "-c", line}, folder).wait();
}

}  // namespace

TEST_CASE("a standard error that is full or closed does not cost the image") {
  const TemporaryFolder folder;
  folder.write("s.rib", sphere_scene());
  for (const char* redirection : {"2>/dev/full", "2>&-", "0<&- 2>&-", "2> >(exit 0)"}) {
    CAPTURE(redirection);
    std::filesystem::remove(folder / "y.exr");
    CHECK(run_redirected("render s.rib -o y.exr", redirection, folder).exit_code == 0);
    CHECK(is_finished_image(folder / "y.exr"));
    if (redirection[2] == ' ') continue;  // a signal ends the rest, as it does everywhere
    // Errors that cannot be said leave their exit code.
    CHECK(run_redirected("render none.rib -o z.exr", redirection, folder).exit_code == 1);
    CHECK(run_redirected("compare none.exr y.exr", redirection, folder).exit_code == 1);
  }
}

TEST_CASE("a standard output that is full or closed is a failure where results are lost") {
  const TemporaryFolder folder;
  folder.write("s.rib", sphere_scene());
  REQUIRE(run_tessera({"render", "s.rib", "-o", "a.exr"}, folder).exit_code == 0);
  for (const char* arguments : {"info s.rib", "compare a.exr a.exr", "--help", "--version"})
    for (const char* redirection : {">/dev/full", ">&-"}) {
      CAPTURE(arguments, redirection);
      const ProgramResult result = run_redirected(arguments, redirection, folder);
      CHECK(result.exit_code == 1);
      CHECK_THAT(result.err, Contains("error: "));
    }
  CHECK(run_redirected("render s.rib -o y.exr", ">/dev/full", folder).exit_code == 1);
  CHECK(is_finished_image(folder / "y.exr"));
  CHECK(run_redirected("render s.rib -o z.exr --quiet", ">/dev/full", folder).exit_code == 0);
}
