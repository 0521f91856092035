// Shadows from depth maps in whole frames: a depth pass from the light, then the picture.

#include <cmath>

#include <catch2/catch.hpp>

#include "engine/outputs.h"
#include "images/exr.h"
#include "tests/engine/program.h"
#include "tests/engine/render_text.h"

using namespace tessera;

namespace {

constexpr double ball_x = 0.3, ball_y = 1.2, ball_z = 0.2, ball_radius = 0.6;
const glm::dvec3 light_from(0.0, 6.0, 0.0);

// A ball above a floor y = 0.
std::string stage() {
  return fmt::format(
      "Polygon \"P\" [-9 0 -9  -9 0 9  9 0 9  9 0 -9]\n"
      "TransformBegin\nTranslate {} {} {}\nSphere {} -{} {} 360\nTransformEnd\n",
      ball_x, ball_y, ball_z, ball_radius, ball_radius, ball_radius);
}

// From the light straight down.
std::string depth_pass(const std::string& file) {
  return "FrameBegin 1\nDisplay \"" + file +
         "\" \"zfile\" \"z\"\n"
         "Format 256 256 1\nPixelSamples 1 1\nPixelFilter \"box\" 1 1\n"
         "Projection \"perspective\" \"fov\" [60]\n"
         "Rotate -90 1 0 0\nTranslate 0 -6 0\n"
         "WorldBegin\n" +
         stage() + "WorldEnd\nFrameEnd\n";
}

std::string picture_pass(const std::string& file, const std::string& rate) {
  return "FrameBegin 2\nFormat 120 90 1\nPixelSamples 3 3\nPixelFilter \"box\" 1 1\n"
         "Projection \"perspective\" \"fov\" [40]\nRotate -30 1 0 0\nTranslate 0.5 -4 6\n"
         "WorldBegin\n"
         "LightSource \"shadowspot\" 1 \"from\" [0 6 0] \"to\" [0 0 0] \"intensity\" [36]\n"
         "  \"coneangle\" [0.5] \"conedeltaangle\" [0] \"beamdistribution\" [0]\n"
         "  \"shadowname\" \"" +
         file + "\" \"string shadowrate\" \"" + rate +
         "\"\n"
         "Surface \"matte\"\n" +
         stage() + "WorldEnd\nFrameEnd\n";
}

// Distance from the ball's centre to the segment between `P` and the light, in radii.
double clearance(const glm::dvec3& P) {
  const glm::dvec3 d = glm::normalize(light_from - P), m = glm::dvec3(ball_x, ball_y, ball_z) - P;
  return glm::length(m - glm::dot(m, d) * d) / ball_radius;
}

// The point of the floor behind a pixel's centre, and whether the ball hides it, by intersecting
// the eye's ray: camera space is world space shifted by (0.5, -4, 6), then turned by -30 degrees
// about x.
bool floor_point(double x, double y, glm::dvec3& P) {
  const double half = std::tan(20.0 * M_PI / 180.0) / 45.0;  // 90 rows are the shorter side
  const glm::dvec3 d((x - 60.0) * half, (45.0 - y) * half, 1.0);
  const double c = std::cos(M_PI / 6.0), s = std::sin(M_PI / 6.0);
  const glm::dvec3 turned(d.x, c * d.y - s * d.z, s * d.y + c * d.z);
  const glm::dvec3 eye(-0.5, 4.0, -6.0);
  if (turned.y >= 0.0) return false;
  P = eye + turned * (-eye.y / turned.y);
  const glm::dvec3 m = glm::dvec3(ball_x, ball_y, ball_z) - eye, unit = glm::normalize(turned);
  return glm::length(m - glm::dot(m, unit) * unit) > 1.1 * ball_radius;
}

}  // namespace

TEST_CASE("a spot light's shadow in a picture is where ray casting puts it") {
  const TemporaryFolder folder;
  const std::string file = folder / "light.z";
  Diagnostics diagnostics;
  SceneCollector sink;
  read_rib_text(depth_pass(file), "depth.rib", sink, diagnostics);
  write_displays(render_frame(*sink.scenes.front(), {}, diagnostics), *sink.scenes.front());
  for (const char* rate : {"cell", "pixel", "sample"}) {
    INFO(rate);
    const FrameResult frame = render_text_frame(picture_pass(file, rate));
    CHECK(frame.statistics.warnings.empty());
    int lit = 0, shadowed = 0;
    for (int y = 0; y < 90; ++y) {
      for (int x = 0; x < 120; ++x) {
        glm::dvec3 P;
        if (!floor_point(x + 0.5, y + 0.5, P)) continue;
        const glm::dvec3 towards = light_from - P;
        const double cosine = towards.y / glm::length(towards);
        // A pixel is at most 0.2 of floor; a texel of the map is 0.03. Edges are left out.
        if (std::abs(std::acos(cosine) - 0.5) < 0.04 || std::abs(clearance(P) - 1.0) < 0.25)
          continue;
        const bool in_cone = std::acos(cosine) < 0.5, blocked = clearance(P) < 1.0;
        const double expected =
            in_cone && !blocked ? 36.0 / glm::dot(towards, towards) * cosine : 0.0;
        CHECK(double(channel_at(frame.image, "G", x, y)) == Approx(expected).epsilon(0.03));
        lit += in_cone && !blocked, shadowed += in_cone && blocked;
      }
    }
    CHECK(lit > 500);
    CHECK(shadowed > 50);
  }
}

TEST_CASE("shadows are the same for any number of threads and bucket size, at every rate") {
  const TemporaryFolder folder;
  const std::string file = folder / "light.z";
  write_exr(file, render_text(depth_pass(file)));
  for (const char* rate : {"cell", "pixel", "sample"}) {
    Settings one, many;
    one.threads = 1, one.bucket_size = 32;
    many.threads = 5, many.bucket_size = 13;
    const Image a = render_text(picture_pass(file, rate), one);
    const Image b = render_text(picture_pass(file, rate), many);
    for (const Image::Channel& channel : a.channels)
      CHECK(channel.values == b.find_channel(channel.name)->values);
  }
}

TEST_CASE("images carry the matrices of their camera, for row vectors") {
  const Image image = render_text(R"(
    Format 80 40 1  Projection "perspective" "fov" [90]  Translate 1 2 3
    WorldBegin  Sphere 1 -1 1 360  WorldEnd)");
  const auto& camera = image.matrices.at("worldToCamera");
  CHECK(camera == std::array<float, 16>{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 2, 3, 1});
  // The world point (1, 0, 1) is (2, 2, 4) in the camera: half way up from the middle of 40 rows,
  // which span [-1, 1], and a quarter of the way right in 80 columns, which span [-2, 2].
  const auto& ndc = image.matrices.at("worldToNDC");
  double p[4];
  for (size_t c = 0; c < 4; ++c) p[c] = double(ndc[c]) + double(ndc[8 + c]) + double(ndc[12 + c]);
  CHECK(p[0] / p[3] == Approx(0.5 + 0.5 * 0.25));
  CHECK(p[1] / p[3] == Approx(0.5 - 0.5 * 0.5));
}

TEST_CASE("MakeShadow makes a shadow map of a depth file that an earlier frame wrote") {
  const TemporaryFolder folder;
  const auto scene = [&](const std::string& made) {
    return depth_pass("light.z") + made + picture_pass("light.shd", "cell");
  };
  folder.write("scene.rib", scene("MakeShadow \"light.z\" \"light.shd\"\n"));
  // Statistics that go to a file make a frame wait for the next one; the map must wait with it.
  const ProgramResult made = run_tessera({"render", "scene.rib", "--stats", "stats.json"}, folder);
  INFO(made.err);
  CHECK(made.exit_code == 0);
  CHECK(made.err.find("warning") == std::string::npos);
  const Image depth = read_exr(folder / "light.z"), map = read_exr(folder / "light.shd");
  CHECK(map.matrices == depth.matrices);
  REQUIRE(map.channels.size() == 1);
  CHECK(map.channels[0].values == depth.channels[0].values);

  folder.write("scene.rib", scene("MakeShadow \"other.z\" \"other.shd\"\n"));
  const ProgramResult missing = run_tessera({"render", "scene.rib"}, folder);
  CHECK_THAT(missing.err, Catch::Contains("MakeShadow") && Catch::Contains("other.z"));
  CHECK(!folder.has("other.shd"));
}
