// Surfaces that shine in whole frames: how much light they send does not depend on how they are
// seen.

#include <cmath>

#include <catch2/catch.hpp>

#include <glm/glm.hpp>

#include "tests/engine/render_text.h"

using namespace tessera;

namespace {

constexpr double intensity = 2000, radius = 0.1, wall_half_width = 0.05;
// Of the lamp from the middle of the wall z = 0, which faces the camera.
const glm::dvec3 lamp(1.5, 0, -2);

/// A wall that fills the frame, `distance` from the eye, and a lamp beside the view.
std::string scene(int width, int height, double distance, const std::string& shadow,
                  const std::string& shape) {
  const double fov_degrees = 2 * std::atan(wall_half_width / distance) * 180 / M_PI;
  return fmt::format(
      "Format {} {} 1\nPixelSamples 2 2\nPixelFilter \"box\" 1 1\n"
      "Projection \"perspective\" \"fov\" [{}]\nTranslate 0 0 {}\n"
      "WorldBegin\n"
      "Attribute \"light\" \"string shadow\" \"{}\"\n"
      "AttributeBegin\n"
      "AreaLightSource \"arealight\" 1 \"intensity\" {} \"float samples\" 4096 "
      "\"string shadowrate\" \"cell\"\n"
      "{}"
      "AttributeEnd\n"
      "Illuminate 1 1\nSurface \"matte\" \"Kd\" 1\n"
      "Polygon \"P\" [-1 -1 0  -1 1 0  1 1 0  1 -1 0]\n"
      "WorldEnd\n",
      width, height, fov_degrees, distance, shadow, intensity, shape);
}

double mean_red(const std::string& rib) {
  const Image image = render_text(rib);
  const std::vector<float>& red = image.find_channel("R")->values;
  double sum = 0;
  for (const float value : red) sum += double(value);
  return sum / double(red.size());
}

struct View {
  int width, height;
  double distance;
};
constexpr View views[] = {{1, 1, 10}, {1, 1, 100}, {1, 1, 400}, {8, 6, 10}, {8, 6, 400}};

/// With and without shadows, from near and from far.
void check_all_views(const std::string& shape, double expected, double tolerance) {
  for (const View& view : views) {
    for (const char* shadow : {"off", "on"}) {
      CAPTURE(view.width, view.distance, shadow);
      CHECK(mean_red(scene(view.width, view.height, view.distance, shadow, shape)) ==
            Approx(expected).epsilon(tolerance));
    }
  }
}

}  // namespace

TEST_CASE("a ball that shines lights as its radiance says, however small it is seen",
          "[arealight]") {
  // All of it is above the wall: radiance (radius / d)^2 cos.
  const double d2 = glm::dot(lamp, lamp), cosine = -lamp.z / std::sqrt(d2);
  const double expected = intensity * radius * radius / d2 * cosine;
  const std::string ball = fmt::format("Translate {} {} {}\nSphere {} -{} {} 360\n", lamp.x, lamp.y,
                                       lamp.z, radius, radius, radius);
  check_all_views(ball, expected, 2e-3);
}

TEST_CASE("a bowl that shines is not in its own way", "[arealight]") {
  // From its axis it looks like the disc of its rim: radiance sin^2 of that, times the cosine.
  constexpr double bowl = 0.5;
  const double d2 = glm::dot(lamp, lamp), cosine = -lamp.z / std::sqrt(d2);
  const double expected = intensity * bowl * bowl / (bowl * bowl + d2) * cosine;
  // The lower half of a ball, turned so that what was +z points from the lamp to the wall's middle.
  const double degrees = std::atan2(-lamp.x, -lamp.z) * 180 / M_PI;
  const std::string shape =
      fmt::format("Translate {} {} {}\nRotate {} 0 1 0\nReverseOrientation\nSphere {} -{} 0 360\n",
                  lamp.x, lamp.y, lamp.z, degrees, bowl, bowl);
  check_all_views(shape, expected, 4e-3);
}
