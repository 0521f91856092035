// Whole frames whose pixels follow from a closed form.

#include <cmath>

#include <catch2/catch.hpp>

#include "tests/engine/render_text.h"

using namespace tessera;

namespace {

struct Moments {
  double mass = 0, x = 0, y = 0, r2 = 0, reach = 0;
};

// Mass, centroid, mean squared radius about `centre` and largest radius of the alpha channel.
Moments alpha_moments(const Image& image, double centre_x, double centre_y) {
  Moments m;
  const PixelRect& window = image.data_window;
  for (int y = window.y0; y < window.y1; ++y) {
    for (int x = window.x0; x < window.x1; ++x) {
      const double a = channel_at(image, "A", x, y);
      const double dx = x + 0.5 - centre_x, dy = y + 0.5 - centre_y;
      m.mass += a, m.x += a * (x + 0.5), m.y += a * (y + 0.5), m.r2 += a * (dx * dx + dy * dy);
      if (a > 0) m.reach = std::max(m.reach, std::hypot(dx, dy));
    }
  }
  m.x /= m.mass, m.y /= m.mass, m.r2 /= m.mass;
  return m;
}

}  // namespace

TEST_CASE("a disc covers pi r^2 pixels") {
  // Orthographic, 100 pixels over 2 units: a disc of radius 0.7 has 35 pixels of radius. Dicing
  // replaces it by a polygon of at least 2 pi 35 / 0.5 = 440 sides, short of the circle's area by
  // (2 pi / 440)^2 / 6 = 3e-5; 64 stratified samples in each pixel leave about 1e-4 of noise.
  const Image image = render_text(R"(
    Format 100 100 1  PixelSamples 8 8  PixelFilter "box" 1 1  ShadingRate 0.25
    Projection "orthographic"
    WorldBegin
      Translate 0 0 1
      Surface "constant"
      Disk 0 0.7 360
    WorldEnd)");
  const Moments m = alpha_moments(image, 50, 50);
  const double radius = 35;
  CHECK(m.mass == Approx(M_PI * radius * radius).epsilon(1e-3));
  CHECK(m.x == Approx(50).margin(0.02));
  CHECK(m.y == Approx(50).margin(0.02));
  CHECK(m.r2 == Approx(radius * radius / 2).epsilon(2e-3));
}

// The right edge of a wide polygon moves from raster x = 30 towards 70 over scene time 0 to 1; the
// shutter closes at `shutter_close`, when it is at `last`. Where a pixel's centre lies a share s of
// the way, it is covered for 1 - s of the shutter.
void check_moving_edge(double shutter_close, double last) {
  const Image image = render_text(fmt::format(R"(
    Format 100 20 1  PixelSamples 16 16  PixelFilter "box" 1 1  Shutter 0 {}
    ScreenWindow -5 5 -1 1
    Projection "orthographic"
    WorldBegin
      Surface "constant"
      MotionBegin [0 1]
        Translate -2 0 1
        Translate 2 0 1
      MotionEnd
      Polygon "P" [-20 -5 0  -20 5 0  0 5 0  0 -5 0]
    WorldEnd)",
                                              shutter_close));
  for (int x = 0; x < 100; ++x) {
    const double expected = std::clamp((last - (x + 0.5)) / (last - 30), 0.0, 1.0);
    // The ramp is linear within every pixel, for it begins and ends at pixel borders, so its mean
    // is the value at the centre. With 256 stratified samples the error of the covered share is of
    // the order of 1/256.
    INFO("column " << x);
    CHECK(channel_at(image, "A", x, 10) == Approx(expected).margin(0.012));
  }
}

TEST_CASE("a linearly moving edge is blurred by a box") { check_moving_edge(1, 70); }

TEST_CASE("motion that fills part of the shutter is seen for that part") {
  check_moving_edge(0.5, 50);
}

TEST_CASE("a defocused point becomes a disc of the circle of confusion") {
  // fov 90 over 200 pixels: 100 pixels per unit at z = 1. f-stop 1, focal length 0.4: lens radius
  // 0.2; in focus at 4, seen at 2: radius 100 * 0.2 * |1/4 - 1/2| = 5 pixels; seen at 8: 2.5.
  for (const auto& [z, radius] : {std::pair{2.0, 5.0}, std::pair{8.0, 2.5}}) {
    const double half = 0.004 * z;  // 0.4 pixels: mean squared radius grows by (2 * 0.4^2) / 3
    const Image image = render_text(fmt::format(R"(
      Format 200 200 1  CropWindow 0.45 0.55 0.45 0.55  PixelSamples 32 32
      PixelFilter "box" 1 1
      Projection "perspective" "fov" [90]  DepthOfField 1 0.4 4
      WorldBegin
        Translate 0 0 {0}
        Surface "constant"
        Polygon "P" [-{1} -{1} 0  -{1} {1} 0  {1} {1} 0  {1} -{1} 0]
      WorldEnd)",
                                                z, half));
    const Moments m = alpha_moments(image, 100, 100);
    INFO("depth " << z);
    CHECK(m.mass == Approx(0.64).epsilon(0.05));  // the quad's own 0.8 x 0.8 pixels
    CHECK(m.x == Approx(100).margin(0.1));
    CHECK(m.y == Approx(100).margin(0.1));
    // Uniform disc: R^2 / 2; the quad adds 0.107, the pixels' own extent 2/12.
    CHECK(m.r2 == Approx(radius * radius / 2 + 0.107 + 1.0 / 6).epsilon(0.04));
    CHECK(m.reach < radius + 0.4 * M_SQRT2 + M_SQRT1_2 + 0.01);
  }
}

TEST_CASE("a subdivided cube passes through its limit points") {
  const Image image = render_text(R"(
    Format 33 33 1  PixelSamples 2 2  PixelFilter "box" 1 1  ShadingRate 0.0625
    Projection "orthographic"
    WorldBegin
      Translate 0 0 5
      Surface "constant"
      SubdivisionMesh "catmull-clark" [4 4 4 4 4 4]
        [0 2 3 1  4 5 7 6  0 1 5 4  2 6 7 3  0 4 6 2  1 3 7 5]
        "P" [-1 -1 -1  1 -1 -1  -1 1 -1  1 1 -1  -1 -1 1  1 -1 1  -1 1 1  1 1 1]
    WorldEnd)");
  // Refining once puts the face point at (0,0,-1), a regular vertex (valence 4) whose edge
  // neighbours are the edge points (0, +-3/4, -3/4) and whose face neighbours are corners
  // (+-5/9, +-5/9, -5/9): limit z = (16 * 1 + 4 * 4 * 3/4 + 4 * 5/9) / 36 = 272/324 = 0.83951.
  CHECK(channel_at(image, "Z", 16, 16) == Approx(5 - 272.0 / 324.0).margin(1e-3));
}
