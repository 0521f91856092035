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
  // Nobody asks for rays, nobody filters.
  for (const char* name : {"rays", "bounce_points_shaded", "extra_samples"}) {
    INFO(name);
    CHECK(json["counts"][name] == 0);
  }
  CHECK(json["memory_bytes"]["ray_bytes"] == 0);
  CHECK(json["memory_bytes"]["bounce_bytes"] == 0);
  CHECK(json["times_s"]["filter_s"] == 0.0);
  CHECK_FALSE(json["ratios"].contains("aaf_bound_spp"));
}

TEST_CASE("statistics tell what rays, more samples and filters cost") {
  const TemporaryFolder folder;
  folder.write("s.rib", rays_scene());
  REQUIRE(
      run_tessera({"render", "s.rib", "-o", "out.exr", "--stats", "s.json"}, folder).exit_code ==
      0);
  const auto json = nlohmann::json::parse(read_text(folder / "s.json"));
  const auto& counts = json["counts"];
  for (const char* name : {"rays", "bounce_points_shaded", "extra_samples"}) {
    INFO(name);
    CHECK(counts[name].get<long>() > 0);
  }
  // What all pixels have and what some have besides, for which whole rectangles are looked at.
  CHECK(counts["samples"].get<long>() >= 32 * 24 * 4 + counts["extra_samples"].get<long>());
  CHECK(counts["extra_samples"].get<long>() <= 32 * 24 * 100);
  CHECK(json["memory_bytes"]["ray_bytes"].get<long>() > 1000);
  // Three floats for every point that bounces asked for and more, for each side of every grid.
  CHECK(json["memory_bytes"]["bounce_bytes"].get<long>() >
        12 * counts["bounce_points_shaded"].get<long>());
  CHECK(json["times_s"]["filter_s"].get<double>() > 0);
  CHECK(json["ratios"]["aaf_bound_spp"].get<double>() >= 4);
  for (const char* need : {"lens", "area_lights", "bounce", "ray_tracing"}) {
    INFO(need);
    CHECK(json["plan"][need] == "yes");
  }
}
