// Heat maps within what is left of a budget; the renderer is a script.

#include <atomic>
#include <filesystem>

#include <catch2/catch.hpp>

#include "tests/trade/trade_fixtures.h"
#include "trade/heat_maps.h"

using namespace tessera::trade;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

// A renderer that writes the files asked for, fails for the measure "extra" and takes 3 s with 64
// samples.
constexpr const char* script = R"(#!/bin/sh
case "$*" in
  *--help*|*--version*) echo fake; exit 0;;
  *"--spp 64"*) sleep 3;;
  *"--heatmap extra"*) echo "error: nothing extra here" >&2; exit 1;;
esac
shift 2
while [ $# -gt 0 ]; do
  case "$1" in
    -o) echo image > "$2";;
    --stats) echo '{}' > "$2";;
  esac
  shift
done
)";

class Maps {
 public:
  Maps() {
    const std::string program = folder_.write("renderer", script);
    fs::permissions(program, fs::perms::owner_all);
    renderer_.emplace(program, "s.rib", std::vector<std::string>(), 50.0, &cancel_);
    for (const auto& [spp, wall_s] : {std::pair{4, 1.0}, {16, 100.0}, {64, 0.2}}) {
      Run& added = runs_.emplace_back(run({}, spp, wall_s, 1.0 / spp));
      added.configuration.id = std::to_string(spp);
      added.configuration.options = {"--spp", std::to_string(spp)};
    }
  }
  HeatMaps render(const std::vector<const Run*>& of, double left_s) {
    return render_heat_maps(*renderer_, of,
                            {folder_ / "", [left_s] { return left_s; }, [] { return false; }});
  }
  const Run* at(size_t i) const { return &runs_[i]; }

 private:
  TestFolder folder_;
  std::atomic<bool> cancel_ = false;
  std::optional<Renderer> renderer_;
  std::vector<Run> runs_;
};

}  // namespace

TEST_CASE("heat maps that do not fit or fail are named, and none takes more than is left") {
  Maps maps;
  // 100 s of the second run do not fit into 20.
  HeatMaps result = maps.render({maps.at(0), maps.at(1)}, 20);
  REQUIRE(result.notes.size() == 2);
  CHECK(result.made ==
        std::vector<std::pair<std::string, std::string>>{{"4", "tests"}, {"4", "shading"}});
  CHECK(result.notes[0] == "no heat map extra of spp=4: nothing extra here");
  CHECK_THAT(result.notes[1],
             Contains("budget was spent: tests of spp=16, shading of spp=16, extra of spp=16"));
  // Predicted to fit, but it takes longer than is left.
  result = maps.render({maps.at(2)}, 0.3);
  CHECK(result.made.empty());
  REQUIRE(result.notes.size() == 1);
  CHECK_THAT(result.notes[0], Contains("budget was spent: tests of spp=64"));
}
