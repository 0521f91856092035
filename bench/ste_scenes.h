#pragma once
/// Three generated scenes of the kinds that Laine et al. 2011, section 4, measure: two with
/// triangles of some 40 pixels and one with triangles below a pixel.

#include <random>

#include "bench/ste_scene.h"

namespace tessera {

/// Uniform numbers that are the same in every standard library.
class SteRandom {
 public:
  explicit SteRandom(uint32_t seed) : engine_(seed) {}
  double operator()(double low, double high) {
    return low + (high - low) * (double(engine_()) / 4294967296.0);
  }

 private:
  std::mt19937 engine_;
};

/// The edge of quads whose triangles have the wanted area when they are seen at a slant.
inline constexpr double large_edge = 13.5, small_edge = 1.35;

inline void add_rectangle(SteScene& scene, const glm::dvec3& corner, const glm::dvec3& along_u,
                          const glm::dvec3& along_v) {
  scene.add([=](double u, double v) { return corner + along_u * u + along_v * v; }, large_edge);
}

/// A floor at height -1.6 in strips, so that quads near and far are of one size on screen.
inline void add_floor(SteScene& scene, double far_depth) {
  for (double z = 1.5; z < far_depth; z *= 1.5)
    add_rectangle(scene, {-1.2 * z, -1.6, z}, {2.4 * z, 0, 0}, {0, 0, 0.5 * z});
}

/// Walls at all depths and angles, several layers deep; the camera dollies and turns.
inline std::unique_ptr<SteScene> make_walls(int width, int height, const SteEffects& effects,
                                            int count) {
  auto scene = std::make_unique<SteScene>(width, height, effects, 3.5, 20.0);
  scene->move_camera({160 / scene->scale, 0, 0.8}, 40 / scene->scale);
  add_floor(*scene, 60);
  add_rectangle(*scene, {-50, -20, 70}, {100, 0, 0}, {0, 50, 0});
  SteRandom random(1);
  for (int n = 0; n < count; ++n) {
    const double z = 3 * std::exp(random(0, 2.5)), yaw = random(-1.1, 1.1),
                 roll = random(-1.5, 1.5);
    const double size = z * random(0.25, 0.5), tall = z * random(0.3, 0.6);
    const double c = std::cos(roll), s = std::sin(roll);
    const glm::dvec3 along{size * c * std::cos(yaw), size * s, size * c * std::sin(yaw)};
    const glm::dvec3 up{-tall * s, tall * c, 0};
    const glm::dvec3 middle{z * random(-0.65, 0.65), z * random(-0.35, 0.35), z};
    add_rectangle(*scene, middle - 0.5 * (along + up), along, up);
  }
  return scene;
}

/// A court with columns; the camera hardly moves, and the focus is on the middle.
inline std::unique_ptr<SteScene> make_court(int width, int height, const SteEffects& effects) {
  auto scene = std::make_unique<SteScene>(width, height, effects, 8.0, 6.0);
  scene->move_camera({40 / scene->scale, 0, 0.25}, 6 / scene->scale);
  add_floor(*scene, 22);
  add_rectangle(*scene, {-9, -1.6, 22}, {18, 0, 0}, {0, 10, 0});
  for (double z = 4; z < 22; z *= 1.3)
    for (const double x : {-6.0, 6.0})
      add_rectangle(*scene, {x, -1.6, z}, {0, 0, 0.3 * z}, {0, 9, 0});
  for (int n = 0; n < 12; ++n) {
    const double x = n % 2 ? 2.2 : -2.2, z = 5 + 2.6 * (n / 2);
    scene->add(
        [=](double u, double v) {
          return glm::dvec3(x + 0.4 * std::cos(6.2831853 * u), -1.6 + 5 * v,
                            z + 0.4 * std::sin(6.2831853 * u));
        },
        large_edge);
  }
  return scene;
}

/// A car's body around its middle: rings, rounded below and with bonnet, cabin and boot above.
inline glm::dvec3 car_body(double u, double v) {
  const double angle = 6.2831853 * u, c = std::cos(angle), s = std::sin(angle);
  const double taper = std::pow(1 - std::pow(std::abs(2 * v - 1), 5.0), 0.35);
  const double cabin = std::exp(-std::pow((v - 0.52) / 0.2, 4.0));
  const double up = s > 0 ? 0.18 + 0.2 * cabin : 0.12;
  return {2 * v - 1, taper * std::copysign(std::sqrt(std::abs(s)), s) * up,
          0.4 * taper * std::copysign(std::sqrt(std::abs(c)), c)};
}

inline glm::dvec3 car_wheel(double u, double v) {
  const double around = 6.2831853 * u, across = 6.2831853 * v;
  const double radius = 0.12 + 0.05 * std::cos(across);
  return {radius * std::cos(around), radius * std::sin(around), 0.05 * std::sin(across)};
}

/// Cars at all depths, driving their own ways by some 50 pixels each.
inline std::unique_ptr<SteScene> make_cars(int width, int height, const SteEffects& effects,
                                           int count) {
  auto scene = std::make_unique<SteScene>(width, height, effects, 24.0, 14.0);
  SteRandom random(2);
  for (int n = 0; n < count; ++n) {
    const double z = 7.5 * std::exp(1.6 * (n + random(0, 1)) / count), heading = random(0, 6.28);
    const glm::dvec3 middle{z * random(-0.5, 0.5), z * random(-0.25, 0.25), z};
    const double c = std::cos(heading), s = std::sin(heading);
    const double step = random(35, 65) * z / scene->scale;
    const double turn = random(0, 6.28);
    const glm::dvec3 velocity{step * std::cos(turn), step * std::sin(turn), random(-0.3, 0.3)};
    const auto place = [=](const glm::dvec3& p) {
      return middle + glm::dvec3(c * p.x - s * p.z, p.y, s * p.x + c * p.z);
    };
    scene->add([=](double u, double v) { return place(car_body(u, v)); }, small_edge, velocity);
    for (const double x : {-0.6, 0.6})
      for (const double side : {-0.38, 0.38})
        scene->add(
            [=](double u, double v) { return place(car_wheel(u, v) + glm::dvec3(x, -0.12, side)); },
            small_edge, velocity);
  }
  return scene;
}

}  // namespace tessera
