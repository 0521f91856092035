// What the user writes about knobs, and what is left out.

#include <algorithm>

#include <catch2/catch.hpp>

#include "base/error.h"
#include "trade/configurations.h"

using namespace tessera;
using namespace tessera::trade;
using Catch::Contains;

namespace {

using Strings = std::vector<std::string>;

SweepRequest request_of(const std::string& knobs) {
  SweepRequest request;
  request.knobs = parse_knobs(knobs);
  request.ladder = {4, 16};
  request.plan.entries = {{"motion", "yes"},     {"lens", "no"},    {"textures", "no"},
                          {"shading", "aas"},    {"hider", "auto"}, {"reconstruct", "filter"},
                          {"area_lights", "no"}, {"bounce", "no"},  {"samples_per_pixel", "16"}};
  request.has_option = [](const std::string&) { return true; };
  return request;
}

Strings labels(const SweepList& list) {
  Strings all;
  for (const Configuration& configuration : list.configurations)
    all.push_back(configuration.label());
  return all;
}

}  // namespace

TEST_CASE("knobs and values are told apart, and arguments of values from values") {
  const auto choices =
      parse_knobs("spp=2:8,hider=shear:dual:2,reconstruct=maaf:9:fsf,shading-rate");
  REQUIRE(choices.size() == 4);
  CHECK(choices[0].values == Strings{"2", "8"});
  CHECK(choices[1].values == Strings{"shear", "dual:2"});
  CHECK(choices[2].values == Strings{"maaf:9", "fsf"});
  CHECK(choices[3].values == find_knob("shading-rate").values);
}

TEST_CASE("what is wrong with a list of knobs is said with what there is") {
  CHECK_THROWS_WITH(parse_knobs("hidr"), Contains("no knob 'hidr'") && Contains("hider"));
  CHECK_THROWS_WITH(parse_knobs("hider,hider=bbox"), Contains("twice"));
  CHECK_THROWS_WITH(parse_knobs("shading-rate=fine"), Contains("number above 0"));
  CHECK_THROWS_WITH(parse_knobs("shading-rate=-1"), Contains("number above 0"));
  CHECK_THROWS_WITH(parse_knobs("hider="), Contains("values"));
  CHECK_THROWS_WITH(parse_knobs("spp,"), Contains("no knob ''"));
  CHECK_THROWS_WITH(parse_knobs("quality"), Contains("--qualities"));
  CHECK_THROWS_WITH(parse_baselines("ds,dx"), Contains("no baseline 'dx'") && Contains("reyes"));
  CHECK_THROWS_WITH(parse_ladder("4,x"), Contains("'x'"));
  CHECK_THROWS_WITH(parse_ladder("0"), Contains("'0'"));
  CHECK_THROWS_WITH(parse_ladder("70000"), Contains("70000"));
  CHECK(parse_ladder("64,4,16,4") == std::vector<int>{4, 16, 64});
}

TEST_CASE("the default has a step between each two of the ladder, and the scene's own") {
  CHECK(default_ladder({4, 16, 64}, 16) == std::vector<int>{4, 8, 16, 32, 64});
  CHECK(default_ladder({4}, 9) == std::vector<int>{4, 9});
}

TEST_CASE("each value is listed once, without the default's own") {
  SweepRequest request = request_of("hider=auto:bbox,share=0.9");
  request.baselines = parse_baselines("bbox,ds");
  const SweepList list = list_configurations(request);
  CHECK(labels(list) == Strings{"spp=4", "spp=8", "spp=16", "hider=bbox spp=4", "hider=bbox spp=16",
                                "share=0.9 spp=4", "share=0.9 spp=16", "shading=ds spp=4",
                                "shading=ds spp=16"});
  CHECK(list.configurations[5].options == Strings{"--spp", "4", "--shading", "aas:share=0.9"});
  CHECK(list.turns.size() == 2);
  CHECK(list.pivot_spp == 16);
  request.ladder = {2, 8};
  CHECK(list_configurations(request).pivot_spp == 8);
  CHECK(list.baselines.size() == 2);
}

TEST_CASE("knobs that cannot matter are left out with the reason") {
  SweepRequest request = request_of("hider=bbox,texture-filter,reconstruct=aaf");
  const auto noted = [&request](const std::string& part) {
    const Strings notes = list_configurations(request).notes;
    return std::any_of(notes.begin(), notes.end(),
                       [&part](const std::string& note) { return note.find(part) != note.npos; });
  };
  CHECK(noted("texture-filter is left out: no surface has a texture"));
  CHECK_FALSE(noted("hider"));
  request.plan.entries["motion"] = "no";
  CHECK(noted("hider is left out: nothing moves"));
  CHECK(noted("reconstruct is left out"));
  request.common = {"--hider", "shear"};
  CHECK(noted("hider is left out: --hider is given for all runs"));
  request.has_option = [](const std::string& option) { return option != "--texture-filter"; };
  CHECK(noted("texture-filter is left out: this renderer has no option --texture-filter"));
}
