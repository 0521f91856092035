// The same image, bit for bit, whatever the threads, the buckets and the hider.

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "images/exr.h"
#include "tests/engine/differing_values.h"
#include "tests/engine/program.h"
#include "tests/engine/scene_text.h"

using namespace tessera;

namespace {

Image render(const TemporaryFolder& folder, std::vector<std::string> options) {
  std::vector<std::string> arguments{
      "render", "s.rib", "-o", "out.exr", "--quiet", "--aov", "rgb,a,z,N,P,motion,id"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  const ProgramResult result = run_tessera(arguments, folder);
  INFO(result.err);
  REQUIRE(result.exit_code == 0);
  return read_exr(folder / "out.exr");
}

}  // namespace

TEST_CASE("threads, bucket size, hider and memory budget do not show in the image") {
  const TemporaryFolder folder;
  folder.write("s.rib", everything_scene());
  const Image reference = render(folder, {"--threads", "1", "--hider", "bbox"});
  for (const std::vector<std::string>& options : std::vector<std::vector<std::string>>{
           {"--threads", "1", "--hider", "shear"},
           {"--threads", "2", "--hider", "bbox"},
           {"--threads", "7", "--hider", "shear"},
           {"--hider", "dual:2"},
           {"--hider", "pixar:2x2x4"},
           {"--hider", "auto"},
           {"--bucket-size", "5"},
           {"--bucket-size", "16", "--threads", "3"},
           {"--bucket-size", "4096"},
           {"--memory", "1"},
       }) {
    INFO(fmt::format("{}", fmt::join(options, " ")));
    CHECK(differing_values(reference, render(folder, options)) == 0);
  }
}

TEST_CASE("another seed gives another image") {
  const TemporaryFolder folder;
  folder.write("s.rib", everything_scene());
  CHECK(differing_values(render(folder, {"--seed", "1"}), render(folder, {"--seed", "2"})) > 100);
}
