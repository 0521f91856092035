/// Every option, attribute and transform request, one by one.

#include <cmath>

#include "rib_test_utils.h"

using namespace tessera;
using namespace tessera::test;

namespace {

const std::string sphere = " Sphere 1 -1 1 360 ";

ReadResult read_options(const std::string& text) {
  return read_text(text + "\nWorldBegin WorldEnd\n");
}

const Attributes& attributes_of(const ReadResult& result, size_t i = 0) {
  return *result.scene().surfaces.at(i).attributes;
}

glm::dvec3 transformed(const std::string& transform, glm::dvec3 P) {
  const auto result = read_world(transform + sphere);
  return glm::dvec3(result.scene().surfaces.at(0).world_from_object.at(0) * glm::dvec4(P, 1.0));
}

void check_point(glm::dvec3 found, glm::dvec3 expected) {
  CAPTURE(found.x, found.y, found.z);
  CHECK(glm::length(found - expected) < 1e-12);
}

}  // namespace

TEST_CASE("camera options") {
  const auto result = read_options(R"(
    Format 320 200 0.9  FrameAspectRatio 1.5  ScreenWindow -1 2 -3 4  CropWindow .1 .2 .3 .4
    Projection "perspective" "fov" [35]  Clipping 0.5 1000  DepthOfField 2.8 0.05 [3]
    Shutter 0.25 0.75
    Option "camera" "string lensprofile" "polygon" "string shutterprofile" ["gaussian"]
           "int lensblades" 5 "float lensrotation" 12.5)");
  const CameraSettings& camera = result.scene().camera;
  CHECK(result.warnings.empty());
  CHECK(camera.x_resolution == 320);
  CHECK(camera.y_resolution == 200);
  CHECK(camera.pixel_aspect == 0.9);
  CHECK(camera.frame_aspect.value() == 1.5);
  CHECK(camera.screen_window->left == -1);
  CHECK(camera.screen_window->right == 2);
  CHECK(camera.screen_window->bottom == -3);
  CHECK(camera.screen_window->top == 4);
  CHECK(camera.crop.x_min == 0.1);
  CHECK(camera.crop.x_max == 0.2);
  CHECK(camera.crop.y_min == 0.3);
  CHECK(camera.crop.y_max == 0.4);
  CHECK(camera.projection == Projection::perspective);
  CHECK(camera.fov_degrees == 35);
  CHECK(camera.near_clip == 0.5);
  CHECK(camera.far_clip == 1000);
  CHECK(camera.lens->f_stop == 2.8);
  CHECK(camera.lens->focal_length == 0.05);
  CHECK(camera.lens->focal_distance == 3);
  CHECK(camera.shutter_open == 0.25);
  CHECK(camera.shutter_close == 0.75);
  CHECK(camera.lens_profile == "polygon");
  CHECK(camera.shutter_profile == "gaussian");
  CHECK(camera.lens_blades == 5);
  CHECK(camera.lens_rotation_degrees == 12.5);
}

TEST_CASE("camera defaults") {
  const CameraSettings camera = read_options("").scene().camera;
  CHECK(camera.projection == Projection::orthographic);
  CHECK(camera.x_resolution == 640);
  CHECK(camera.y_resolution == 480);
  CHECK(!camera.lens);
  CHECK(!read_options("DepthOfField 1 1 1 DepthOfField").scene().camera.lens);
  CHECK(!read_options("DepthOfField 1e38 1 1").scene().camera.lens);
  CHECK(read_options("Projection \"perspective\"").scene().camera.fov_degrees == 90);
  const auto through_matrix = read_options("Perspective 40");
  CHECK(through_matrix.scene().camera.projection == Projection::perspective);
  CHECK(through_matrix.scene().camera.fov_degrees == 40);
}

TEST_CASE("image options and displays") {
  const auto result = read_options(R"(
    PixelSamples 3 2  PixelFilter "mitchell" 4 5  Exposure 2 2.2
    Display "old.exr" "file" "rgb"
    Display "a.exr" "openexr" "rgba" "string compression" "zip"
    Display "+b.exr" "file" "P" "int[2] origin" [1 2]
    Hider "hidden" "jitter" 1  Option "limits" "bucketsize" [16 16] "gridsize" 256
    Option "searchpath" "texture" "/a:/b" "string archive" ["x:&:@"]
    Option "searchpath" "string texture" ["&:/c"]
    Option "mine" "float[2] pair" [1 2]
    Quantize "rgba" 255 0 255 0.5 PixelVariance 0.1 RelativeDetail 1 version 3.03)");
  const Scene& scene = result.scene();
  CHECK(result.warnings.empty());
  CHECK(scene.options.x_samples == 3);
  CHECK(scene.options.y_samples == 2);
  CHECK(scene.options.filter == "mitchell");
  CHECK(scene.options.filter_x_width == 4);
  CHECK(scene.options.filter_y_width == 5);
  CHECK(scene.options.exposure_gain == 2);
  CHECK(scene.options.exposure_gamma == 2.2f);
  REQUIRE(scene.displays.size() == 2);
  CHECK(scene.displays[0].file == "a.exr");
  CHECK(scene.displays[0].mode == "rgba");
  CHECK(scene.displays[0].parameters.at(0).strings.at(0) == "zip");
  CHECK(scene.displays[1].file == "b.exr");
  CHECK(scene.displays[1].parameters.at(0).numbers == std::vector<float>{1, 2});
  CHECK(scene.options.hider == "hidden");
  CHECK(scene.options.hider_parameters.at(0).name == "jitter");
  CHECK(scene.options.bucket_size.value() == 16);
  CHECK(scene.options.grid_size.value() == 256);
  CHECK(scene.options.texture_path == std::vector<std::string>{"/a", "/b", "/c"});
  CHECK(scene.options.archive_path == std::vector<std::string>{"x"});
  CHECK(scene.options.user.at("mine:pair").numbers == std::vector<float>{1, 2});
}

TEST_CASE("options out of range are refused") {
  const std::vector<std::pair<const char*, const char*>> table = {
      {"Format 1e6 10 1", "at most 65536 pixels"},
      {"Format 1.5 10 1", "expected an integer, found 1.5"},
      {"FrameAspectRatio 0", "positive aspect"},
      {"CropWindow 0.5 0.5 0 1", "xmin < xmax"},
      {"Projection \"fisheye\"", "\"perspective\" or \"orthographic\""},
      {"Projection \"perspective\" \"fov\" 180", "between 0 and 180"},
      {"Clipping 2 1", "near < far"},
      {"DepthOfField 0 1 1", "positive f-stop"},
      {"DepthOfField 1", "expected 3 numbers, found 1"},
      {"Shutter 1 0", "close at or after"},
      {"PixelSamples 0 1", "samples along each axis"},
      {"PixelFilter \"box\" 0 1", "positive filter widths"},
      {"Exposure 1 0", "positive gamma"},
      {"Display \"a\" \"file\"", "expected a string, found no further argument"},
      {"Option \"limits\" \"bucketsize\" [-1]", "bucketsize"},
      {"ScreenWindow 1 1 0 1", "screen window with an area"}};
  for (const auto& [text, message] : table) {
    CAPTURE(text);
    CHECK_THAT(error_of(std::string("\n") + text), Contains(message) && Contains("test.rib:2: "));
  }
}

TEST_CASE("attributes") {
  const auto result = read_world(R"(
    Declare "wide" "varying color[2]"
    Color [.1 .2 .3]  Opacity .4 .5 .6  ShadingRate 4  ShadingInterpolation "constant"  Sides 1
    Matte 1  TextureCoordinates [1 2 3 4 5 6 7 8]
    GeometricApproximation "motionfactor" 1.5  GeometricApproximation "focusfactor" .5
    GeometricApproximation "flatness" 1
    Attribute "identifier" "name" ["ball"]  Attribute "mine" "constant float x" 3  Attribute "dice" "rate" 2.5
    Surface "plastic" "Kd" .7 "uniform color tint" [1 0 1] "wide" [1 2 3 4 5 6]
    Translate 1 2 3
    Displacement "bumps" "string file" "a.tex")" +
                                 sphere);
  const Attributes& a = attributes_of(result);
  CHECK(result.warnings.empty());
  CHECK(a.color == glm::vec3(.1f, .2f, .3f));
  CHECK(a.opacity == glm::vec3(.4f, .5f, .6f));
  CHECK(a.shading_rate == 4);
  CHECK_FALSE(a.smooth_shading);
  CHECK_FALSE(a.two_sided);
  CHECK(a.matte);
  CHECK(a.texture_coordinates[3] == glm::vec2(7, 8));
  CHECK(a.motion_factor == 1.5f);
  CHECK(a.focus_factor == .5f);
  CHECK(a.name == "ball");
  CHECK(a.user.at("mine:x").numbers.at(0) == 3);
  CHECK(a.user.at("dice:rate").numbers == std::vector<float>{2.5f});
  REQUIRE(a.surface);
  CHECK(a.surface->name == "plastic");
  CHECK(a.surface->where.line == 9);
  CHECK(find_parameter(a.surface->parameters, "Kd")->numbers.at(0) == .7f);
  CHECK(find_parameter(a.surface->parameters, "tint")->type == ValueType::color);
  CHECK(find_parameter(a.surface->parameters, "wide")->array_size == 2);
  CHECK(a.surface->world_from_shader.at(0) == glm::dmat4(1));
  CHECK(glm::dvec3(a.displacement->world_from_shader.at(0)[3]) == glm::dvec3(1, 2, 3));
  CHECK(find_parameter(a.displacement->parameters, "file")->strings.at(0) == "a.tex");
}

TEST_CASE("attribute blocks nest and shapes share unchanged attributes") {
  const auto result =
      read_world("Color 1 0 0" + sphere + sphere + "AttributeBegin Color 0 1 0" + sphere +
                 "Translate 1 0 0 AttributeEnd" + sphere +
                 "TransformBegin Color 0 0 1 Translate 1 0 0 TransformEnd" + sphere);
  CHECK(attributes_of(result, 0).color == glm::vec3(1, 0, 0));
  CHECK(result.scene().surfaces[0].attributes == result.scene().surfaces[1].attributes);
  CHECK(attributes_of(result, 2).color == glm::vec3(0, 1, 0));
  CHECK(attributes_of(result, 3).color == glm::vec3(1, 0, 0));
  CHECK(attributes_of(result, 4).color == glm::vec3(0, 0, 1));
  for (const Surface& surface : result.scene().surfaces)
    CHECK(surface.world_from_object.at(0) == glm::dmat4(1));
}

TEST_CASE("displacement bounds come in world units") {
  const auto bound = [](const std::string& text) {
    return attributes_of(read_world(text + sphere)).displacement_bound;
  };
  CHECK(bound("Attribute \"displacementbound\" \"sphere\" 0.5 Scale 2 3 1") == 1.5f);
  CHECK(bound("Scale 1 4 2 Attribute \"displacementbound\" \"sphere\" 1 \"coordinatesystem\" "
              "\"current\" Scale 9 9 9") == 4.0f);
  CHECK(bound("Scale 5 5 5 CoordinateSystem \"five\" Identity Attribute \"displacementbound\" "
              "\"sphere\" 1 \"coordinatesystem\" \"five\"") == 5.0f);
  CHECK(bound("Rotate 30 1 1 0 Scale 1 7 2 Rotate 50 0 1 3 Attribute \"displacementbound\" "
              "\"sphere\" 1") == Approx(7.0f));
  CHECK(bound("Scale 3 3 3 Attribute \"displacementbound\" \"sphere\" 2 \"coordinatesystem\" "
              "\"world\"") == 2.0f);
}

TEST_CASE("lights: handles, scope, switching and area lights") {
  const auto result = read_text(R"(
    Rotate 90 0 1 0
    LightSource "ambientlight" 1 "intensity" .3
    Translate 0 0 5
    WorldBegin
      LightSource "pointlight" "key" "from" [1 2 3]
      Sphere 1 -1 1 360
      AttributeBegin
        LightSource "distantlight" 2  Illuminate 1 0
        Sphere 1 -1 1 360
        AreaLightSource "glow" 7
        Sphere 1 -1 1 360
      AttributeEnd
      LightSource "distantlight" 1
      Illuminate "key" 0
      Illuminate 99 1
      Sphere 1 -1 1 360
    WorldEnd)");
  const Scene& scene = result.scene();
  REQUIRE(scene.lights.size() == 5);
  CHECK(attributes_of(result, 0).lights == std::vector<int>{0, 1});
  CHECK(attributes_of(result, 1).lights == std::vector<int>{1, 2});
  CHECK_FALSE(attributes_of(result, 1).area_light);
  CHECK(attributes_of(result, 2).area_light.value() == 3);
  // A handle used again names the new light; the old one stays on.
  CHECK(attributes_of(result, 3).lights == std::vector<int>{0, 4});
  CHECK(scene.lights[3].area);
  CHECK(scene.lights[1].handle == "key");
  CHECK(scene.lights[1].shader.parameters.at(0).type == ValueType::point);
  CHECK(result.warnings.size() == 1);
  // Declared before the camera moved back by 5: the light stands at world z = -5.
  const glm::dvec4 origin = scene.lights[0].shader.world_from_shader.at(0)[3];
  check_point(glm::dvec3(origin), {0, 0, -5});
}

TEST_CASE("lights keep the attribute that asks for ray-traced shadows") {
  const auto result = read_world(R"(
    LightSource "pointlight" 1
    AttributeBegin
      Attribute "light" "string shadow" "on"
      LightSource "pointlight" 2
      AreaLightSource "arealight" 3 "float intensity" 2
    AttributeEnd
    Attribute "light" "string shadows" ["off"]
    LightSource "rectanglelight" 4 "float width" 2 "string shadowrate" "pixel"
    LightSource "domelight" 5)");
  const Scene& scene = result.scene();
  REQUIRE(scene.lights.size() == 5);
  const char* const expected[] = {"", "on", "on", "off", "off"};
  for (size_t i = 0; i < 5; ++i) CHECK(scene.lights[i].shadow == expected[i]);
  CHECK(result.warnings.empty());
}

TEST_CASE("transforms against closed forms") {
  check_point(transformed("Translate 1 2 3", {1, 1, 1}), {2, 3, 4});
  check_point(transformed("Scale 2 3 4", {1, 1, 1}), {2, 3, 4});
  check_point(transformed("Rotate 90 0 0 1", {1, 0, 0}), {0, 1, 0});
  check_point(transformed("Rotate 90 0 1 0", {0, 0, 1}), {1, 0, 0});
  check_point(transformed("Rotate 90 2 0 0", {0, 1, 0}), {0, 0, 1});
  // The later transform acts first.
  check_point(transformed("Translate 1 0 0 Scale 2 2 2", {1, 0, 0}), {3, 0, 0});
  // Row vectors: translation in the last row.
  check_point(transformed("ConcatTransform [1 0 0 0  0 1 0 0  0 0 1 0  5 6 7 1]", {1, 1, 1}),
              {6, 7, 8});
  check_point(transformed("ConcatTransform [0 1 0 0  -1 0 0 0  0 0 1 0  0 0 0 1]", {1, 0, 0}),
              {0, 1, 0});
  check_point(transformed("Scale 9 9 9 Transform 1 0 0 0 0 1 0 0 0 0 1 0 5 6 7 1", {0, 0, 0}),
              {5, 6, 7});
  check_point(transformed("Translate 1 1 1 Identity", {1, 2, 3}), {1, 2, 3});
  // The y axis leans by 45 degrees towards x; x stays.
  check_point(transformed("Skew 45 0 1 0 1 0 0", {0, 1, 0}), {1, 1, 0});
  check_point(transformed("Skew 45 0 1 0 1 0 0", {1, 0, 5}), {1, 0, 5});
  check_point(transformed("Skew -30 0 0 1 0 1 0", {0, 0, 1}), {0, -std::tan(M_PI / 6), 1});
  check_point(transformed("Translate 1 2 3 CoordinateSystem \"a\" Scale 3 3 3 "
                          "CoordSysTransform \"a\"",
                          {0, 0, 0}),
              {1, 2, 3});
}

TEST_CASE("camera space, world space and named spaces") {
  const auto result = read_text(R"(
    Translate 0 0 10  CoordinateSystem "rig"  Rotate 90 0 1 0
    WorldBegin
      Translate 1 0 0  CoordinateSystem "here"
      CoordSysTransform "camera"  Sphere 1 -1 1 360
      CoordSysTransform "rig"     Sphere 1 -1 1 360
      CoordSysTransform "world"   Sphere 1 -1 1 360
      CoordSysTransform "nowhere" Sphere 1 -1 1 360
    WorldEnd)");
  const Scene& scene = result.scene();
  const glm::dmat4 camera_from_world = scene.camera.camera_from_world.at(0);
  check_point(glm::dvec3(camera_from_world * glm::dvec4(0, 0, 1, 1)), {1, 0, 10});
  const auto origin_in_camera = [&](size_t i) {
    return glm::dvec3(camera_from_world * scene.surfaces.at(i).world_from_object.at(0)[3]);
  };
  check_point(origin_in_camera(0), {0, 0, 0});
  check_point(origin_in_camera(1), {0, 0, 10});
  check_point(glm::dvec3(scene.surfaces[2].world_from_object.at(0)[3]), {0, 0, 0});
  check_point(glm::dvec3(scene.coordinate_systems.at("here").at(0)[3]), {1, 0, 0});
  CHECK(scene.coordinate_systems.count("rig") == 1);
  REQUIRE(result.warnings.size() == 1);
  CHECK_THAT(result.warnings[0], Contains("no coordinate system is called \"nowhere\""));
}

TEST_CASE("frames carry their options, and each world is one scene") {
  const auto result = read_text(R"(
    Format 100 100 1  PixelSamples 2 2
    FrameBegin 3
      PixelSamples 8 8  LightSource "ambientlight" 1
      WorldBegin Sphere 1 -1 1 360 WorldEnd
    FrameEnd
    FrameBegin 4 WorldBegin Sphere 1 -1 1 360 Sphere 1 -1 1 360 WorldEnd FrameEnd
    WorldBegin WorldEnd)");
  REQUIRE(result.frames.size() == 3);
  CHECK(result.frames[0]->frame_number == 3);
  CHECK(result.frames[0]->options.x_samples == 8);
  CHECK(result.frames[0]->lights.size() == 1);
  CHECK(result.frames[1]->frame_number == 4);
  CHECK(result.frames[1]->options.x_samples == 2);
  CHECK(result.frames[1]->camera.x_resolution == 100);
  CHECK(result.frames[1]->lights.empty());
  CHECK(result.frames[1]->surfaces.size() == 2);
  CHECK(result.frames[1]->surfaces[1].id == 1);
  CHECK(result.frames[2]->frame_number == 0);
}

TEST_CASE("a sink can stop the reading") {
  CollectFrames sink;
  sink.wanted = 1;
  Diagnostics diagnostics;
  read_rib_text("WorldBegin WorldEnd WorldBegin WorldEnd ] nonsense", "test.rib", sink,
                diagnostics);
  CHECK(sink.frames.size() == 1);
}

TEST_CASE("unsupported and unknown requests are skipped with one warning each") {
  const auto result = read_world(R"(
    Curves "cubic" [4] "nonperiodic" "P" [0 0 0 1 1 1 2 2 2 3 3 3] "width" [1 2]
    Points "P" [0 0 0]  Points "P" [0 0 0]
    NoSuchThing [1 2] "a" 3
    SolidBegin "union" Color 1 0 0 Sphere 1 -1 1 360 SolidEnd
    IfBegin "$x == 1" Sphere 2 -1 1 360 IfBegin "" IfEnd Else Sphere 3 -1 1 360 IfEnd
    Procedural "RunProgram" ["prog" "data"] [-1 1 -1 1 -1 1]
    Surface "plastic" "Kd" 1 "nobody" [1 2 3] "Ks" .5
    MotionBegin [0 1] Points "P" [0 0 0] Points "P" [0 0 1] MotionEnd
    Sphere 1 -1 1 360)");
  CHECK(result.scene().surfaces.size() == 2);
  CHECK(attributes_of(result, 1).color == glm::vec3(1));
  CHECK(find_parameter(attributes_of(result, 1).surface->parameters, "Ks")->numbers[0] == .5f);
  REQUIRE(result.warnings.size() == 7);
  CHECK(result.warnings[0] ==
        "test.rib:3: warning: the request Curves is not supported yet: skipped");
  CHECK_THAT(result.warnings[2], Contains("NoSuchThing is not known"));
  CHECK_THAT(result.warnings[6], Contains("\"nobody\" has not been declared"));
}
