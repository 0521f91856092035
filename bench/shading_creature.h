#pragma once
/// The winged creature of the arena: subdivision surfaces that deform between motion keys.

#include <numbers>

#include "bench/shading_rib.h"

namespace tessera {

/// Hovers at the origin of the space in force, its head towards -z; wings reach to x = +-5.5. Time
/// is in shutters from the middle of a wing beat, where wings are fastest.
class Creature {
 public:
  explicit Creature(const ShadingSceneRequest& request) : request_(request) {}

  void add(RibText& rib) const {
    rib.add(
        "Surface \"paintedplastic\" \"Ks\" [0.5] \"roughness\" [0.06] \"Kd\" [0.8] "
        "\"string texturename\" [\"{}/scales.exr\"]",
        request_.textures);
    rib.add("Color [1.2 1.2 1.2]");
    spine_tube(rib);
    for (const double side : {-1.0, 1.0}) {
      rib.attribute([&] { wing(rib, side); });
      rib.attribute([&] { fingers(rib, side); });
      legs(rib, side);
    }
    rib.attribute([&] { head(rib); });
  }

 private:
  static constexpr int motion_keys = 3;

  /// Of the spine, s in [0, 1] from the nose to the tip of the tail.
  static glm::dvec3 spine(double s, double time) {
    const double sway = 0.25 * std::sin(5 * s + 1.5 * time) * s;
    return {sway, 0.9 * std::exp(-16 * s * s) * (1 + 0.15 * time) + 0.5 * s * s - 0.12 * time,
            -2.4 + 7.4 * s};
  }
  static double girth(double s) {
    const double belly = std::exp(-std::pow((s - 0.33) / 0.14, 2));
    return 0.06 + 0.24 * (1 - s) + 0.5 * belly - 0.06 * std::exp(-300 * s * s);
  }

  void spine_tube(RibText& rib) const {
    constexpr int around = 10, along = 24;
    rib.moving(request_.motion, motion_keys, [&](double time) {
      rib.sheet({around, along, true, {4, 10}}, [&](int i, int j) {
        const double s = double(j) / (along - 1), angle = 2 * std::numbers::pi * i / around;
        const double r = j == 0 || j == along - 1 ? 0.02 : girth(s);
        return spine(s, time) + glm::dvec3(r * std::cos(angle), 1.1 * r * std::sin(angle), 0);
      });
    });
  }

  /// Of a wing, a in [0, 1] from shoulder to tip, b from the leading to the trailing edge.
  glm::dvec3 wing_point(double side, double a, double b, double time) const {
    // Radians at the shoulder: two beats a sequence.
    const double beat = 0.42 * time + 0.4 * std::sin(4 * std::numbers::pi * request_.place);
    const double lift = 0.35 + beat * (0.5 + 0.9 * a) - 0.5 * a * a;
    const double chord =
        (2.9 - 1.2 * a) * (1 - 0.18 * std::abs(std::sin(4 * std::numbers::pi * a)) * b);
    const double reach = 5.4 * a + 0.4;
    const double sag =
        -0.25 * std::sin(std::numbers::pi * b) * std::abs(std::sin(4 * std::numbers::pi * a));
    return {side * reach * std::cos(lift), 0.55 + reach * std::sin(lift) + sag,
            -0.9 + 1.4 * a * a + chord * b};
  }

  void wing(RibText& rib, double side) const {
    constexpr int across = 18, along = 7;
    rib.add(
        "Surface \"paintedplastic\" \"Ks\" [0.35] \"roughness\" [0.12] \"Kd\" [0.9] "
        "\"string texturename\" [\"{}/cloth.exr\"]",
        request_.textures);
    rib.add("Color [1.1 0.75 0.7]");
    rib.moving(request_.motion, motion_keys, [&](double time) {
      rib.sheet({across, along, false, {2, 1}}, [&](int i, int j) {
        return wing_point(side, double(i) / (across - 1), double(j) / (along - 1), time);
      });
    });
  }

  /// Bones along the leading edge and across the wing.
  void fingers(RibText& rib, double side) const {
    rib.add("Surface \"plastic\" \"Ks\" [0.8] \"roughness\" [0.05]");
    rib.add("Color [0.55 0.42 0.25]");
    const auto bone = [&](const std::function<glm::dvec3(double s, double time)>& path, double r) {
      constexpr int around = 6, along = 12;
      rib.moving(request_.motion, motion_keys, [&](double time) {
        rib.sheet({around, along, true}, [&](int i, int j) {
          const double s = double(j) / (along - 1), angle = 2 * std::numbers::pi * i / around;
          const glm::dvec3 ahead = glm::normalize(path(s + 0.01, time) - path(s, time));
          const glm::dvec3 up(0, 1, 0), out = glm::normalize(glm::cross(up, ahead));
          const double radius = r * (1.1 - s);
          return path(s, time) +
                 radius * (std::cos(angle) * out + std::sin(angle) * glm::cross(ahead, out));
        });
      });
    };
    bone([&](double s, double time) { return wing_point(side, s, 0, time); }, 0.14);
    for (const double a : {0.25, 0.5, 0.75})
      bone([&](double s, double time) { return wing_point(side, a, s, time); }, 0.07);
  }

  void legs(RibText& rib, double side) const {
    for (const double s : {0.26, 0.42})
      rib.moving(request_.motion, motion_keys, [&](double time) {
        constexpr int around = 6, along = 6;
        rib.sheet({around, along, true, {1, 2}}, [&](int i, int j) {
          const double t = double(j) / (along - 1), angle = 2 * std::numbers::pi * i / around;
          const double r = j == along - 1 ? 0.02 : 0.24 * (1 - 0.7 * t);
          const glm::dvec3 hip = spine(s, time) + glm::dvec3(0.4 * side, -0.2, 0);
          return hip + glm::dvec3(0.4 * side * t + r * std::cos(angle), -1.3 * t,
                                  0.5 * std::sin(3 * t) + 0.3 * time * t + r * std::sin(angle));
        });
      });
  }

  void head(RibText& rib) const {
    const auto at_head = [&](const glm::dvec3& offset, const auto& content) {
      rib.attribute([&] {
        rib.moving(request_.motion, motion_keys, [&](double time) {
          const glm::dvec3 p = spine(0.01, time) + offset;
          rib.add("Translate {} {} {}", p.x, p.y, p.z);
        });
        content();
      });
    };
    at_head({0, 0.05, -0.1}, [&] {
      rib.add("Scale 0.75 0.7 1.2");
      rib.add("Sphere 0.5 -0.5 0.5 360");
    });
    at_head({0, -0.1, -0.65}, [&] {
      rib.add("Scale 0.6 0.45 1");
      rib.add("Sphere 0.5 -0.5 0.5 360");
    });
    for (const double side : {-1.0, 1.0}) {
      at_head({0.25 * side, 0.2, -0.42}, [&] {
        rib.add("Surface \"plastic\" \"Ks\" [1] \"roughness\" [0.02]");
        rib.add("Color [0.9 0.55 0.05]");
        rib.add("Sphere 0.11 -0.11 0.11 360");
      });
      at_head({0.22 * side, 0.3, 0.1}, [&] {
        rib.add("Surface \"metal\" \"roughness\" [0.1]");
        rib.add("Color [0.9 0.8 0.6]");
        rib.add("Rotate {} 0 1 0 Rotate -50 1 0 0", 20 * side);
        rib.add("Cone 0.9 0.12 360");
      });
    }
  }

  ShadingSceneRequest request_;
};

}  // namespace tessera
