// Named settings, and what overrides them.

#include <catch2/catch.hpp>

#include "base/error.h"
#include "engine/qualities.h"
#include "tests/engine/program.h"
#include "tests/engine/scene_text.h"

using namespace tessera;
using Catch::Matchers::Contains;

namespace {

Settings with(std::string_view name, Settings settings = {}) {
  settings.quality = name;
  return with_quality(settings);
}

}  // namespace

TEST_CASE("a quality fills in what is unset") {
  for (const QualityDefinition& row : quality_registry()) {
    const Settings settings = with(row.name);
    CHECK(settings.samples_per_pixel == row.samples_per_pixel);
    CHECK(settings.error == row.error);
    CHECK(settings.max_samples == row.max_samples);
    CHECK(settings.shading_rate == row.shading_rate);
    CHECK(settings.dicing_rate == row.dicing_rate);
    // Either so many samples, or as many as an error takes.
    CHECK(row.samples_per_pixel.has_value() != row.error.has_value());
  }
  CHECK_FALSE(with_quality({}).samples_per_pixel);
  CHECK_THROWS_WITH(with("superb"), Contains("draft"));
}

TEST_CASE("options given themselves override a quality") {
  Settings rates;
  rates.shading_rate = 2.0f;
  rates.texture_filter = "point";
  const Settings draft = with("draft", rates);
  CHECK(draft.shading_rate == 2.0f);
  CHECK(draft.texture_filter == "point");
  CHECK(draft.samples_per_pixel == find_quality("draft").samples_per_pixel);

  Settings error;
  error.error = 0.2;
  CHECK(with("draft", error).error == 0.2);
  CHECK_FALSE(with("draft", error).samples_per_pixel);
  Settings samples;
  samples.samples_per_pixel = 3;
  CHECK(with("final", samples).samples_per_pixel == 3);
  CHECK_FALSE(with("final", samples).error);
  CHECK_FALSE(with("final", samples).max_samples);
  Settings limit;
  limit.max_samples = 40;
  CHECK(with("final", limit).max_samples == 40);
  CHECK(with("final", limit).error == find_quality("final").error);
}

TEST_CASE("the program prints the quality and takes its options") {
  const TemporaryFolder folder;
  folder.write("s.rib", sphere_scene());
  const ProgramResult draft =
      run_tessera({"render", "s.rib", "-o", "o.exr", "--quality", "draft", "--verbose"}, folder);
  CHECK(draft.exit_code == 0);
  CHECK_THAT(draft.out, Contains("quality                      draft"));
  CHECK_THAT(draft.out, Contains("dicing_rate                  4"));
  const ProgramResult limited = run_tessera(
      {"render", "s.rib", "-o", "o.exr", "--quality", "final", "--max-spp", "16", "--verbose"},
      folder);
  CHECK(limited.exit_code == 0);
  CHECK_THAT(limited.out, Contains("spp_limit                    16"));
  const ProgramResult unknown =
      run_tessera({"render", "s.rib", "-o", "o.exr", "--quality", "best"}, folder);
  CHECK(unknown.exit_code == 2);
  CHECK_THAT(unknown.err, Contains("draft preview final"));
  const ProgramResult textures =
      run_tessera({"render", "s.rib", "-o", "o.exr", "--texture-filter", "cubic"}, folder);
  CHECK(textures.exit_code == 2);
  CHECK_THAT(textures.err, Contains("point bilinear trilinear anisotropic"));
}
