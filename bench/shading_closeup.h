#pragma once
/// A soldier of a few polished parts close to the camera: head, torso, backpack, arms, a rifle.
/// Each part moves in its own way, from hardly to wildly; nothing is out of focus.

#include "bench/shading_rib.h"

namespace tessera {

class Closeup {
 public:
  explicit Closeup(const ShadingSceneRequest& request) : request_(request) {}

  std::string text() const {
    RibText rib;
    ShadingSceneRequest pinhole = request_;
    pinhole.lens = "pinhole";
    rib.options(pinhole, 36, 0, 0);
    rib.camera([](double) { return CameraPose{{-1.1, 1.0, -5.6}, {0.05, 0.72, 0}}; }, 0);
    rib.add("WorldBegin");
    add_daylight(rib, 0.2, 0.75);
    rib.add(
        "LightSource \"spotlight\" 4 \"intensity\" [15] \"lightcolor\" [0.7 0.85 1] "
        "\"from\" [3.5 4 -2.5] \"to\" [0 0.8 0] \"coneangle\" [0.6] \"conedeltaangle\" [0.2]");
    room(rib);
    turning(rib, 10, {0, 0, 0}, [&] {
      torso(rib);
      turning(rib, -14, {0, 1.2, 0}, [&] { head(rib); });
      turning(rib, 8, {0, 0, 0.5}, [&] { backpack(rib); });
      arm(rib, -1);
      arm(rib, 1);
    });
    swinging(rib, [&] { rifle(rib); });
    rib.add("WorldEnd");
    return rib.text();
  }

 private:
  static constexpr int motion_keys = 5;

  /// Turns by so many degrees a shutter about the vertical through `pivot`.
  void turning(RibText& rib, double degrees, const glm::dvec3& pivot,
               const std::function<void()>& content) const {
    rib.attribute([&] {
      rib.add("Translate {} {} {}", pivot.x, pivot.y, pivot.z);
      rib.moving(request_.motion, motion_keys,
                 [&](double time) { rib.add("Rotate {} 0 1 0", degrees * time); });
      rib.add("Translate {} {} {}", -pivot.x, -pivot.y, -pivot.z);
      content();
    });
  }
  /// Of the rifle: up about the right hand, and round.
  void swinging(RibText& rib, const std::function<void()>& content) const {
    rib.attribute([&] {
      rib.add("Translate 0.35 0.3 -1.05");
      rib.moving(request_.motion, motion_keys,
                 [&](double time) { rib.add("Rotate {} 0 0 1", 22 + 16 * time); });
      rib.moving(request_.motion, motion_keys,
                 [&](double time) { rib.add("Rotate {} 0 1 0", -8 + 8 * time); });
      content();
    });
  }

  void plate(RibText& rib, double roughness, const glm::dvec3& color) const {
    rib.add("Surface \"metal\" \"Ka\" [1.2] \"Ks\" [1.3] \"roughness\" [{}]", roughness);
    rib.add("Color [{} {} {}]", color.x, color.y, color.z);
  }
  void paint(RibText& rib, const char* texture, double roughness) const {
    rib.add(
        "Surface \"paintedplastic\" \"Ks\" [0.7] \"Kd\" [0.75] \"roughness\" [{}] "
        "\"string texturename\" [\"{}/{}.exr\"]",
        roughness, request_.textures, texture);
    rib.add("Color [1 1 1]");
  }
  void gloss(RibText& rib, const glm::dvec3& color, double roughness = 0.03) const {
    rib.add("Surface \"plastic\" \"Ks\" [0.9] \"Kd\" [0.6] \"roughness\" [{}]", roughness);
    rib.add("Color [{} {} {}]", color.x, color.y, color.z);
  }
  void ball(RibText& rib, const glm::dvec3& center, const glm::dvec3& radii) const {
    rib.add("TransformBegin Translate {} {} {} Scale {} {} {} Sphere 1 -1 1 360 TransformEnd",
            center.x, center.y, center.z, radii.x, radii.y, radii.z);
  }

  void room(RibText& rib) const {
    rib.attribute([&] {
      paint(rib, "panels", 0.15);
      rib.quad({-9, 7, 5}, {18, 0, 0}, {0, -10, 0}, {4, 2.2});
      rib.quad({-9, -1.6, 5}, {18, 0, 0}, {0, 0, -14}, {4, 3});
    });
    rib.attribute([&] {  // pipes along the wall
      plate(rib, 0.08, {0.8, 0.5, 0.3});
      for (const double y : {2.6, 2.95, -0.4})
        rib.add(
            "TransformBegin Translate -9 {} 4.7 Rotate 90 0 1 0 Cylinder 0.14 0 18 360 "
            "TransformEnd",
            y);
      gloss(rib, {0.8, 0.65, 0.1});
      for (int k = 0; k < 7; ++k) ball(rib, {-6 + 2.0 * k, 1.2, 4.7}, {0.2, 0.2, 0.2});
    });
  }

  /// A body of revolution that is wider than deep, from y0 to y1.
  void trunk(RibText& rib, double y0, double y1, const glm::dvec2& st_repeats,
             const std::function<glm::dvec2(double s)>& half_size) const {
    constexpr int around = 14, along = 10;
    rib.sheet({around, along, true, st_repeats}, [&](int i, int j) {
      const double s = double(j) / (along - 1), angle = 2 * std::numbers::pi * i / around;
      const glm::dvec2 half = half_size(s);
      return glm::dvec3(half.x * std::cos(angle), glm::mix(y0, y1, s), half.y * std::sin(angle));
    });
  }

  void torso(RibText& rib) const {
    rib.attribute([&] {
      paint(rib, "cloth", 0.1);
      trunk(rib, -1.8, 0.1, {4, 3}, [](double s) { return glm::dvec2(0.62 - 0.08 * s, 0.42); });
    });
    rib.attribute([&] {
      paint(rib, "panels", 0.06);
      trunk(rib, -0.1, 1.1, {3, 1.5}, [](double s) {
        return glm::dvec2(0.6 + 0.32 * std::sin(2.6 * s), 0.45 + 0.1 * std::sin(3 * s)) *
               (s > 0.95 ? 0.4 : 1.0);
      });
    });
    rib.attribute([&] {  // collar, belt and buckles
      plate(rib, 0.05, {0.85, 0.86, 0.9});
      rib.add(
          "TransformBegin Translate 0 1.08 0 Rotate -90 1 0 0 Torus 0.34 0.1 0 360 360 "
          "TransformEnd");
      rib.add(
          "TransformBegin Translate 0 -0.12 0 Scale 1 1 0.75 Rotate -90 1 0 0 "
          "Torus 0.6 0.08 0 360 360 TransformEnd");
      for (int k = 0; k < 5; ++k) ball(rib, {-0.4 + 0.2 * k, -0.1, -0.5}, {0.07, 0.09, 0.06});
      gloss(rib, {0.15, 0.65, 0.9});
      ball(rib, {-0.3, 0.65, -0.5}, {0.1, 0.1, 0.06});
    });
  }

  void head(RibText& rib) const {
    rib.attribute([&] {
      gloss(rib, {0.85, 0.6, 0.47}, 0.15);
      constexpr int around = 20, along = 14;
      rib.sheet({around, along, true}, [&](int i, int j) {
        const double polar = std::numbers::pi * j / (along - 1);
        const double angle = 2 * std::numbers::pi * i / around;
        const glm::dvec3 d(std::sin(polar) * std::cos(angle), -std::cos(polar),
                           std::sin(polar) * std::sin(angle));
        // A nose, brows and a chin rise from an egg.
        const auto bump = [&](const glm::dvec3& where, double width) {
          const glm::dvec3 away = d - glm::normalize(where);
          return std::exp(-glm::dot(away, away) / (width * width));
        };
        const double r = 1 + 0.32 * bump({0, -0.12, -1}, 0.16) + 0.1 * bump({0.35, 0.25, -1}, 0.2) +
                         0.1 * bump({-0.35, 0.25, -1}, 0.2) + 0.12 * bump({0, -0.8, -0.8}, 0.3);
        return glm::dvec3(0, 1.65, 0) + r * d * glm::dvec3(0.4, 0.52, 0.45);
      });
    });
    for (const double side : {-1.0, 1.0})
      rib.attribute([&] {
        gloss(rib, {0.9, 0.9, 0.88}, 0.01);
        ball(rib, {0.15 * side, 1.71, -0.39}, {0.075, 0.06, 0.05});
        gloss(rib, {0.1, 0.25, 0.45}, 0.01);
        ball(rib, {0.15 * side, 1.71, -0.425}, {0.035, 0.035, 0.025});
        plate(rib, 0.06, {0.7, 0.72, 0.78});  // ear pieces
        ball(rib, {0.42 * side, 1.68, 0.02}, {0.08, 0.16, 0.14});
      });
    rib.attribute([&] {
      paint(rib, "panels", 0.04);
      rib.add(
          "TransformBegin Translate 0 1.8 0.05 Scale 0.47 0.5 0.5 Rotate -112 1 0 0 "
          "Sphere 1 0.12 1 360 TransformEnd");
      plate(rib, 0.05, {0.95, 0.75, 0.35});
      rib.add(
          "TransformBegin Translate 0 1.8 0.05 Scale 0.47 0.5 0.5 Rotate -112 1 0 0 "
          "Translate 0 0 0.12 Torus 1 0.07 0 360 360 TransformEnd");
    });
  }

  void backpack(RibText& rib) const {
    rib.attribute([&] {
      paint(rib, "panels", 0.04);
      rib.box({0, 0.6, 0.85}, {0.75, 0.85, 0.28});
      plate(rib, 0.05, {0.8, 0.83, 0.88});
      for (const double x : {-0.95, 0.95}) {
        rib.add(
            "TransformBegin Translate {} -0.1 0.8 Rotate -90 1 0 0 Cylinder 0.22 0 1.4 360 "
            "TransformEnd",
            x);
        ball(rib, {x, 1.3, 0.8}, {0.22, 0.22, 0.22});
      }
      plate(rib, 0.08, {0.9, 0.55, 0.35});
      rib.add(
          "TransformBegin Translate 0.62 1.4 0.85 Rotate -90 1 0 0 Cylinder 0.025 0 1.4 360 "
          "TransformEnd");
      gloss(rib, {0.9, 0.1, 0.05});
      ball(rib, {0.62, 2.8, 0.85}, {0.07, 0.07, 0.07});
    });
  }

  /// From the shoulder to the hand at the rifle.
  void arm(RibText& rib, double side) const {
    rib.attribute([&] {
      plate(rib, 0.07, {0.75, 0.78, 0.84});
      ball(rib, {0.98 * side, 0.9, 0}, {0.3, 0.3, 0.32});
      paint(rib, "cloth", 0.1);
      constexpr int around = 10, along = 9;
      rib.sheet({around, along, true, {2, 4}}, [&](int i, int j) {
        const double s = double(j) / (along - 1), angle = 2 * std::numbers::pi * i / around;
        const double r = (0.22 - 0.09 * s) * (j == 0 || j == along - 1 ? 0.3 : 1);
        const glm::dvec3 elbow_out(0.2 * side * std::sin(3 * s), 0, 0);
        const glm::dvec3 hand(0.35 - 0.25 * (1 - side), 0.2, -1.0);
        const glm::dvec3 middle = glm::mix(glm::dvec3(0.98 * side, 0.85, 0), hand, s) + elbow_out -
                                  glm::dvec3(0, 0.45 * std::sin(3 * s), 0);
        return middle +
               glm::dvec3(r * std::cos(angle), r * std::sin(angle), 0.4 * r * std::cos(angle));
      });
    });
    rib.attribute([&] {
      gloss(rib, {0.12, 0.12, 0.13}, 0.08);
      ball(rib, {0.35 - 0.25 * (1 - side), 0.22, -1.05}, {0.16, 0.14, 0.16});
    });
  }

  /// Along -x from the right hand.
  void rifle(RibText& rib) const {
    const auto tube = [&](double from, double to, double y, double radius) {
      rib.add("TransformBegin Translate {} {} 0 Rotate -90 0 1 0 Cylinder {} 0 {} 360 TransformEnd",
              from, y, radius, from - to);
    };
    rib.attribute([&] {
      paint(rib, "panels", 0.05);
      rib.box({-0.1, 0.05, 0}, {0.65, 0.13, 0.09}, {2, 0.5});
      plate(rib, 0.04, {0.55, 0.57, 0.62});
      tube(-0.7, -2.0, 0.08, 0.055);
      tube(-1.85, -2.05, 0.08, 0.08);
      tube(-0.7, -1.3, -0.03, 0.075);
      plate(rib, 0.05, {0.9, 0.7, 0.35});
      tube(0.3, -0.4, 0.27, 0.07);
      gloss(rib, {0.35, 0.18, 0.08}, 0.06);
      rib.box({0.75, -0.02, 0}, {0.28, 0.12, 0.07});
      rib.box({-0.25, -0.25, 0}, {0.1, 0.22, 0.06});
    });
  }

  ShadingSceneRequest request_;
};

}  // namespace tessera
