// Arguments of shading modes: what is taken and what is said about the rest.

#include <catch2/catch.hpp>

#include "shade/mode_arguments.h"
#include "tests/shade/fixtures.h"

using namespace tessera;
using namespace tessera::test;
using Catch::Matchers::Contains;

namespace {

double share = 0, size = 0;

void read(std::string_view arguments) {
  share = size = -5;
  read_mode_arguments(
      "mode", arguments,
      {{"share", "share of energy", &share, 0, 1}, {"size", "of it", &size, -2, 9}});
}

}  // namespace

TEST_CASE("arguments are read by name, in any order, and the rest stays") {
  read("");
  CHECK(share == -5);
  read("size=4.5,share=0.25");
  CHECK(share == 0.25);
  CHECK(size == 4.5);
  read("size=-1e-1");
  CHECK(size == -0.1);
  CHECK(share == -5);
  read("share=1");
  CHECK(share == 1);
}

TEST_CASE("numbers outside their interval, and what is no number, are refused") {
  for (const char* text : {"0", "1.001", "-1", "nan", "inf", "-inf", "1e400", "abc", "", "0.5x",
                           " 0.5", "0.5 ", "0,5", "0.5=0.5"}) {
    INFO(text);
    CHECK_THROWS_AS(read(std::string("share=") + text), Error);
  }
  CHECK_THROWS_WITH(read("share=1.5"),
                    Contains("\"mode\"") && Contains("share (share of energy)") &&
                        Contains("above 0 and at most 1") && Contains("\"1.5\""));
  CHECK_THROWS_WITH(read("share"), Contains("above 0 and at most 1") && Contains("\"\""));
}

TEST_CASE("unknown, empty and repeated arguments are refused, with what there is") {
  CHECK_THROWS_WITH(read("shares=0.5"), Contains("unknown argument \"shares=0.5\"") &&
                                            Contains("share=NUMBER, size=NUMBER"));
  CHECK_THROWS_AS(read(","), Error);
  CHECK_THROWS_AS(read("share=0.5,"), Error);
  CHECK_THROWS_AS(read("share=0.5,,size=1"), Error);
  CHECK_THROWS_WITH(read("share=0.5,size=1,share=0.6"),
                    Contains("share") && Contains("more than once"));
  CHECK_THROWS_WITH(read_mode_arguments("plain", "x=1", {}),
                    Contains("\"plain\"") && Contains("\"x=1\"") && Contains("none"));
}

TEST_CASE("each shading mode takes its own arguments only") {
  TestScene test;
  test.scene.camera.lens = CameraSettings::ThinLens{2, 0.4, 5};
  const auto bindings = test.bind();
  const ShadingFrame frame{bindings, true, true};
  for (const char* spec : {"aas", "aas:", "aas:share=0.9", "aas:lens=0.5,shutter=0.8,filter=0.99",
                           "ds", "pixel", "sample", "reyes"}) {
    INFO(spec);
    CHECK(make_shading(spec, frame) != nullptr);
  }
  for (const char* spec :
       {"aas:share=0", "aas:share=1", "aas:share=-1", "aas:share=nan", "aas:share=abc",
        "aas:share=0.99995", "aas:lens=0", "aas:shutter=2", "aas:filter=-0.5"}) {
    INFO(spec);
    CHECK_THROWS_WITH(make_shading(spec, frame),
                      Contains("\"aas\"") && Contains("above 0 and at most 0.9999"));
  }
  CHECK_THROWS_WITH(make_shading("aas:unknown=1", frame),
                    Contains("share=NUMBER, lens=NUMBER, shutter=NUMBER, filter=NUMBER"));
  for (const char* mode : {"ds", "pixel", "sample", "reyes"}) {
    INFO(mode);
    CHECK_THROWS_WITH(make_shading(std::string(mode) + ":x=1", frame),
                      Contains(fmt::format("\"{}\"", mode)) && Contains("x=1"));
  }
  CHECK_THROWS_WITH(make_shading("nothing", frame),
                    Contains("\"nothing\"") && Contains("aas, ds, pixel, reyes, sample"));
}
