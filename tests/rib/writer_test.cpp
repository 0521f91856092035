/// Parse, write, parse: the same scene, and the same text from then on.

#include <sstream>

#include "rib_test_utils.h"
#include "scenes/rib/rib_writer.h"

using namespace tessera;
using namespace tessera::test;

namespace {

std::string rewritten(const std::string& text) {
  std::ostringstream out;
  RibWriter writer(out);
  Diagnostics diagnostics;
  parse_rib_text(text, "test.rib", writer, diagnostics);
  return out.str();
}

void check_same(const MovingTransform& a, const MovingTransform& b) {
  CHECK(a.times() == b.times());
  CHECK(a.matrices() == b.matrices());
}

void check_same(const std::vector<Parameter>& a, const std::vector<Parameter>& b) {
  REQUIRE(a.size() == b.size());
  for (size_t i = 0; i < a.size(); ++i) {
    CHECK(a[i].name == b[i].name);
    CHECK(a[i].storage == b[i].storage);
    CHECK(a[i].type == b[i].type);
    CHECK(a[i].array_size == b[i].array_size);
    CHECK(a[i].numbers == b[i].numbers);
    CHECK(a[i].strings == b[i].strings);
  }
}

void check_same(const Scene& a, const Scene& b) {
  check_same(a.camera.camera_from_world, b.camera.camera_from_world);
  CHECK(a.camera.fov_degrees == b.camera.fov_degrees);
  CHECK(a.options.texture_path == b.options.texture_path);
  REQUIRE(a.lights.size() == b.lights.size());
  REQUIRE(a.surfaces.size() == b.surfaces.size());
  for (size_t i = 0; i < a.surfaces.size(); ++i) {
    const Surface &s = a.surfaces[i], &t = b.surfaces[i];
    check_same(s.world_from_object, t.world_from_object);
    CHECK(s.flip_normal == t.flip_normal);
    CHECK(s.geometry->P_object == t.geometry->P_object);
    CHECK(s.geometry->shape.index() == t.geometry->shape.index());
    check_same(s.geometry->primvars, t.geometry->primvars);
    CHECK(s.attributes->color == t.attributes->color);
    CHECK(s.attributes->lights == t.attributes->lights);
    REQUIRE(bool(s.attributes->surface) == bool(t.attributes->surface));
    if (s.attributes->surface)
      check_same(s.attributes->surface->parameters, t.attributes->surface->parameters);
  }
}

const std::string scene = R"(
  Format 320 240 1  FrameAspectRatio 1.5  ScreenWindow -1 1 -1 1  CropWindow 0 .3 .1 1
  Projection "perspective" "fov" 41.7  Clipping .1 1e30  DepthOfField 4 .1 3.3  DepthOfField
  Shutter 0 .1  PixelSamples 3 3  PixelFilter "sinc" 4 4  Exposure 1.1 2.2
  Display "a\"\\\n.exr" "file" "rgb"  Display "+b" "file" "z" "int[2] origin" [1 2]
  Hider "hidden" "jitter" 1  Option "searchpath" "texture" "a:b"
  MakeShadow "a.z" "a.shd" "float swidth" 2
  Rotate 33.3 1 2 3  CoordinateSystem "c"
  MotionBegin [0 .1] Translate 0 0 .1 Translate 0 0 .7 MotionEnd
  ObjectBegin 1 Color .1 .2 .3 Torus 2 .3 0 360 360 ObjectEnd
  FrameBegin 7 WorldBegin
  LightSource "spotlight" 4 "from" [1 2 3] "coneangle" .7  AreaLightSource "area" "x"
  AreaLightSource "" 0  Illuminate 4 0
  AttributeBegin Opacity 1 .5 .25  Surface "plastic" "Kd" .1 "varying color[2] q" [1 2 3 4 5 6]
  Displacement "d"  ShadingRate .7  ShadingInterpolation "constant"  Sides 1  Orientation "rh"
  ReverseOrientation  Matte 1  TextureCoordinates 0 0 .1 0 0 1 1 1
  GeometricApproximation "motionfactor" .1  Basis "b-spline" 1 "power" 4
  Attribute "identifier" "name" "n"
  PatchMesh "bicubic" 4 "periodic" 4 "nonperiodic" "Pz" [1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 .1]
  AttributeEnd
  TransformBegin Transform 1 0 0 0 0 1 0 0 0 0 1 0 .1 .2 .3 1 CoordSysTransform "c"
  Skew 30 0 1 0 1 0 0
  SubdivisionMesh "catmull-clark" [4 4] [0 1 3 2 2 3 5 4]
    ["crease" "corner" "hole" "interpolateboundary" "facevaryinginterpolateboundary"]
    [3 2 1 1 1 0 1 0 1 0] [0 1 3 0 1 2 2] [.1 9 3]
    "P" [0 0 0 1 0 0 0 1 0 1 1 0 0 2 0 1 2 0]
    "facevarying float[2] st" [0 0 1 0 0 1 1 1 0 0 1 0 0 1 1 1]
  NuPatch 2 2 [0 0 1 1] 0 1 2 2 [0 0 .5 .5] 0 .5 "Pw" [0 0 0 1 1 0 0 1 0 1 0 2 1 1 0 1]
  TransformEnd
  GeneralPolygon [4 3] "P" [0 0 0 3 0 0 3 3 0 0 3 0 1 1 0 2 1 0 1 2 0] "uniform string tag" "t"
  ObjectInstance 1  Sphere 1 -1 1 360 "constant string who" "me"
  Cone 1 1 360 Cylinder 1 0 1 360 Hyperboloid 1 0 0 1 1 1 360 Paraboloid 1 0 1 360 Disk 0 1 360
  SubdivisionMesh "loop" [3] [0 1 2] "P" [0 0 0 1 0 0 0 1 0]
  WorldEnd FrameEnd)";

}  // namespace

TEST_CASE("a scene survives being written") {
  const std::string once = rewritten(scene);
  CHECK(rewritten(once) == once);
  CHECK_THAT(once, Catch::Contains("MakeShadow \"a.z\" \"a.shd\"\n"));
  const auto a = read_text(scene), b = read_text(once);
  CHECK(a.warnings.empty());
  CHECK(b.warnings.empty());
  REQUIRE(a.frames.size() == 1);
  REQUIRE(b.frames.size() == 1);
  CHECK(a.scene().surfaces.size() == 12);
  check_same(a.scene(), b.scene());
  CHECK(b.frames[0]->displays.at(0).file == "a\"\\\n.exr");
  CHECK(b.frames[0]->displays.at(1).file == "b");
}
