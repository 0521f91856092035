// The file that --stats writes.

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/engine/program.h"
#include "tests/engine/scene_text.h"

using namespace tessera;

TEST_CASE("statistics are complete and consistent") {
  const TemporaryFolder folder;
  folder.write("s.rib", "Blobby 1 [1] [1] [\"\"]\n" + everything_scene());
  REQUIRE(
      run_tessera({"render", "s.rib", "-o", "out.exr", "--stats", "s.json"}, folder).exit_code ==
      0);
  const auto json = nlohmann::json::parse(read_text(folder / "s.json"));
  for (const char* section : {"times_s", "counts", "ratios", "memory_bytes", "plan", "options"}) {
    INFO(section);
    REQUIRE(json.contains(section));
    CHECK(json[section].is_object());
    CHECK_FALSE(json[section].empty());
  }
  for (const char* name : {"grids", "micropolygons", "samples", "samples_tested", "samples_covered",
                           "points_shaded", "fragments"}) {
    INFO(name);
    REQUIRE(json["counts"].contains(name));
    CHECK(json["counts"][name].get<long>() > 0);
  }
  const auto& counts = json["counts"];
  CHECK(counts["samples"] == 80 * 60 * 9);
  CHECK(counts["samples_covered"] <= counts["samples_tested"]);
  CHECK(json["ratios"]["ste"].get<double>() ==
        Approx(counts["samples_covered"].get<double>() / counts["samples_tested"].get<double>()));
  CHECK(json["times_s"]["frame_s"].get<double>() > 0);
  CHECK(json["memory_bytes"]["peak_resident_bytes"].get<long>() > 1 << 20);
  CHECK(json["plan"]["motion"] == "yes");
  CHECK(json["plan"]["lens"] == "yes");
  CHECK(json["plan"]["textures"] == "no");
  CHECK(json["plan"]["samples"] == "free");
  CHECK(json["warnings"].size() == 1);
}
