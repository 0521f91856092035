/// Input that is broken in every way: each case reads or throws Error; nothing crashes or hangs.

#include <random>

#include "rib_test_utils.h"

using namespace tessera;
using namespace tessera::test;

namespace {

/// A scene that touches every kind of request and token.
const std::string sample = R"(##RenderMan RIB
version 3.03  Declare "k" "uniform float[2]"
Option "searchpath" "archive" "a:&"  Format 8 8 1  Shutter 0 1  PixelFilter "box" 1 1
Display "x\n.exr" "file" "rgba"  Projection "perspective" "fov" [40]  Translate 0 0 5
FrameBegin 1
LightSource "ambientlight" 1 "intensity" .5
MotionBegin [0 1] Rotate 0 0 1 0 Rotate 9 0 1 0 MotionEnd
ArchiveBegin "in" Sphere 1 -1 1 360 ArchiveEnd
ObjectBegin 2 Color [1 0 0] Disk 0 1 360 ObjectEnd
WorldBegin
AttributeBegin Surface "plastic" "Kd" .5 "k" [1 2] "uniform color c" [1 1 1]
Basis "b-spline" 1 [1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1] 4
PatchMesh "bilinear" 2 "nonperiodic" 2 "nonperiodic" "P" [0 0 0 1 0 0 0 1 0 1 1 0]
SubdivisionMesh "catmull-clark" [4] [0 1 3 2] ["crease" "hole"] [2 1 1 0] [0 1 0] [2]
  "P" [0 0 0 1 0 0 0 1 0 1 1 0] "st" [0 0 1 0 0 1 1 1]
NuPatch 2 2 [0 0 1 1] 0 1 2 2 [0 0 1 1] 0 1 "Pw" [0 0 0 1 1 0 0 1 0 1 0 1 1 1 0 1]
AttributeEnd
TransformBegin Scale 2 2 2 ObjectInstance 2 ReadArchive "in" TransformEnd
Orientation "rh" Polygon "P" [0 0 0 1 0 0 1 1 0] Curves "linear" [2]
WorldEnd FrameEnd
)";

/// 1 if the text reads, 0 if it throws Error; anything else escapes and fails the test.
int reads(std::string_view text) {
  try {
    read_text(text);
    return 1;
  } catch (const Error& error) {
    CHECK(std::string(error.what()).size() < 2000);
    return 0;
  }
}

}  // namespace

TEST_CASE("the sample itself reads") {
  const auto result = read_text(sample);
  REQUIRE(result.frames.size() == 1);
  CHECK(result.scene().surfaces.size() == 6);
}

TEST_CASE("a file cut at any byte reads or is refused") {
  int refused = 0;
  for (size_t length = 0; length < sample.size(); ++length)
    refused += 1 - reads(std::string_view(sample).substr(0, length));
  // From the first open block on, everything shorter than the whole is incomplete.
  CHECK(refused > int(sample.size() - sample.find("FrameBegin")) - 20);
  CHECK_THAT(error_of(sample.substr(0, sample.find("WorldEnd"))),
             Contains("WorldEnd was expected, for the block begun at test.rib:10"));
}

TEST_CASE("changed bytes, deleted and doubled pieces, and noise") {
  std::mt19937 random(20240607);
  const auto below = [&](size_t n) { return size_t(random() % n); };
  int read = 0;
  for (int i = 0; i < 4000; ++i) {
    std::string text = sample;
    for (size_t edits = 1 + below(4); edits > 0; --edits) {
      const size_t place = below(text.size());
      const size_t length = std::min(below(12) + 1, text.size() - place);
      switch (below(3)) {
        case 0:
          text[place] = char(below(256));
          break;
        case 1:
          text.erase(place, length);
          break;
        default:
          text.insert(below(text.size()), text.substr(place, length));
      }
    }
    read += reads(text);
  }
  CHECK(read > 0);
  for (int i = 0; i < 6000; ++i) {
    std::string noise(below(300), ' ');
    for (char& c : noise) c = i % 2 ? char(below(256)) : char(0x80 + below(0x60));
    // Half of the cases start with a request, so that more than the first token is tried.
    reads(i % 4 < 2 ? "WorldBegin Sphere " + noise : noise);
  }
}

TEST_CASE("deep nesting is refused, not followed") {
  for (const char* begin : {"AttributeBegin ", "TransformBegin ", "SolidBegin \"union\" ",
                            "IfBegin \"\" ", "ArchiveBegin \"a\" ", "WorldBegin ", "FrameBegin 1 ",
                            "ObjectBegin 1 ", "MotionBegin [0 1] "}) {
    std::string text;
    for (int i = 0; i < 100000; ++i) text += begin;
    CAPTURE(begin);
    CHECK_FALSE(error_of(text).empty());
  }
  CHECK_THAT(error_of("A " + std::string(100000, '[')), Contains("in the array begun on line 1"));
}

TEST_CASE("mismatched blocks say what was open") {
  CHECK(error_of("WorldBegin\nAttributeBegin\nTransformEnd") ==
        "test.rib:3: found TransformEnd, expected AttributeEnd for the block begun at test.rib:2");
  CHECK_THAT(error_of("WorldEnd"), Contains("no block is open"));
  CHECK_THAT(error_of("WorldBegin WorldBegin"), Contains("found WorldBegin between WorldBegin"));
  CHECK_THAT(error_of("AttributeBegin FrameBegin 1"), Contains("found FrameBegin"));
  CHECK_THAT(error_of("ArchiveEnd"), Contains("no ArchiveBegin is open"));
  CHECK_THAT(error_of("Scale 0 0 0 WorldBegin"), Contains("camera transform cannot be inverted"));
}

TEST_CASE("files that are no RIB are refused early") {
  CHECK_THAT(error_of("\x89PNG\r\n\x1a\n"), Contains("expected a request, found the number"));
  CHECK_THAT(error_of("<scene>"), Contains("found '<'"));
  CHECK_THAT(error_of("42"), Contains("expected a request, found the number 42"));
  std::string prose;
  for (int i = 0; i < 5000; ++i) prose += fmt::format("word{} ", i);
  CHECK_THAT(error_of(prose), Contains("more than 100 unknown requests"));
}
