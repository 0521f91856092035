#pragma once
/// An arena under a wide aperture: a winged creature in focus, pillars before and behind it, walls
/// and seats far away.

#include "bench/shading_creature.h"

namespace tessera {

class Arena {
 public:
  explicit Arena(const ShadingSceneRequest& request) : request_(request) {}

  std::string text() const {
    RibText rib;
    rib.options(request_, 40, aperture_radius, distance);
    rib.camera(
        [this](double time) {
          return CameraPose{{-4.0 + 1.5 * request_.place + 0.45 * time, 3.6 + 0.1 * time, -19.5},
                            {0, 5.2, 0},
                            1.2 * time};
        },
        request_.motion);
    rib.add("WorldBegin");
    add_daylight(rib, 0.22, 0.85);
    rib.add(
        "LightSource \"spotlight\" 4 \"intensity\" [260] \"lightcolor\" [1 0.9 0.7] "
        "\"from\" [-6 16 -9] \"to\" [0 4 0] \"coneangle\" [0.5] \"conedeltaangle\" [0.15]");
    surroundings(rib);
    seats(rib);
    pillars(rib);
    rib.attribute([&] {
      rib.add(
          "Translate 0 4.9 0 Rotate 24 0 1 0 Rotate 8 0 0 1 Rotate 20 1 0 0 Scale 1.15 1.15 1.15");
      Creature(request_).add(rib);
    });
    rib.add("WorldEnd");
    return rib.text();
  }

 private:
  static constexpr double aperture_radius = 0.25, distance = 20;
  static constexpr double wall_radius = 30, wall_height = 9;

  void surroundings(RibText& rib) const {
    rib.attribute([&] {
      rib.add("Surface \"constant\"");
      rib.add(
          "Polygon \"P\" [-400 -20 240  -400 260 240  400 260 240  400 -20 240] "
          "\"Cs\" [0.75 0.8 0.82  0.16 0.3 0.58  0.16 0.3 0.58  0.75 0.8 0.82]");
    });
    rib.attribute([&] {
      rib.add(
          "Surface \"paintedplastic\" \"Ks\" [0.15] \"Kd\" [0.75] \"string texturename\" "
          "[\"{}/paving.exr\"]",
          request_.textures);
      rib.quad({-32, 0, -32}, {64, 0, 0}, {0, 0, 64}, {9, 9});
    });
    rib.attribute([&] {  // a ring on the floor
      rib.add("Surface \"marble\" \"frequency\" [0.6]");
      rib.add("Color [0.75 0.4 0.3]");
      rib.add("Translate 0 0.02 0 Rotate -90 1 0 0");
      rib.add("Hyperboloid 9 0 0 12 0 0 360");
    });
    rib.attribute([&] {
      rib.add("Attribute \"displacementbound\" \"float sphere\" [0.3]");
      rib.add("Displacement \"bumpy\" \"amplitude\" [0.16] \"frequency\" [1.6] \"octaves\" [3]");
      rib.add(
          "Surface \"paintedplastic\" \"Ks\" [0.3] \"Kd\" [0.75] \"string texturename\" "
          "[\"{}/wall.exr\"]",
          request_.textures);
      rib.add("TextureCoordinates [0 {0} {1} {0} 0 0 {1} 0]", 2, 26);
      rib.add("Rotate -90 1 0 0");
      rib.add("Cylinder {} 0 {} 360", wall_radius, wall_height);
    });
  }

  /// Steps above the wall, with people.
  void seats(RibText& rib) const {
    constexpr int tiers = 6, people = 110;
    for (int tier = 0; tier < tiers; ++tier) {
      const double inner = wall_radius + 1.8 * tier, y = wall_height + 1.1 * tier;
      rib.attribute([&] {
        rib.add(
            "Surface \"checker\" \"frequency\" [90] \"color blackcolor\" [0.35 0.3 0.24] \"Kd\" "
            "[0.8]");
        rib.add("Color [0.62 0.55 0.45]");
        rib.add("Rotate -90 1 0 0");
        rib.add("Cylinder {} {} {} 360", inner, y, y + 1.1);
        rib.add("Color [0.5 0.45 0.38]");
        rib.add("Hyperboloid {} 0 {} {} 0 {} 360", inner, y + 1.1, inner + 1.8, y + 1.1);
      });
      for (int k = 0; k < people; ++k) person(rib, tier, k, people, inner + 0.9, y + 1.1);
    }
  }

  static double pick(int a, int b) {
    return std::abs(std::fmod(std::sin(12.9898 * a + 78.233 * b) * 43758.5453, 1.0));
  }

  void person(RibText& rib, int tier, int k, int people, double radius, double y) const {
    if (pick(tier, k) < 0.25) return;
    const double angle = 2 * std::numbers::pi * (k + 0.4 * pick(k, tier + 9)) / people;
    if (std::sin(angle) < 0) return;  // behind the camera
    rib.attribute([&] {
      rib.add("Surface \"plastic\" \"Ks\" [0.2]");
      rib.add("Color [{:.3g} {:.3g} {:.3g}]", 0.2 + 0.7 * pick(k, 31),
              0.15 + 0.6 * pick(k, 57 + tier), 0.15 + 0.6 * pick(k, 83));
      rib.add("Translate {:.5g} {:.5g} {:.5g}", radius * std::cos(angle), y + 0.55,
              radius * std::sin(angle));
      rib.add("TransformBegin Scale 0.8 1.3 0.8 Sphere 0.42 -0.42 0.42 360 TransformEnd");
      rib.add("Color [0.7 0.5 0.4] Translate 0 0.72 0 Sphere 0.24 -0.24 0.24 360");
    });
  }

  void pillars(RibText& rib) const {
    constexpr int ring = 14;
    for (int k = 0; k < ring; ++k) {
      const double angle = 2 * std::numbers::pi * (k + 0.5) / ring;
      const double x = 19 * std::cos(angle), z = 19 * std::sin(angle);
      if (z > -8) pillar(rib, x, z, 0.95, 11);
    }
    // Near the camera, one at each side.
    pillar(rib, -6.4, -12.2, 0.7, 9);
    pillar(rib, 0.7, -14.4, 0.34, 3.1);
  }

  void pillar(RibText& rib, double x, double z, double radius, double height) const {
    rib.attribute([&] {
      rib.add("Translate {} 0 {} Rotate -90 1 0 0", x, z);
      rib.add("Surface \"marble\" \"frequency\" [0.9] \"float veining\" [2.5] \"Ks\" [0.3]");
      rib.add("Color [0.8 0.76 0.7]");
      rib.add("Cylinder {} 0 {} 360", radius, height);
      rib.add("Torus {} {} 0 360 360", radius * 1.15, radius * 0.3);
      rib.add("Hyperboloid {} 0 {} {} 0 {} 360", radius, height, radius * 1.6, height + radius);
      rib.add("TransformBegin Translate 0 0 {} Disk 0 {} 360 TransformEnd", height + radius,
              radius * 1.6);
      ornaments(rib, radius, height);
    });
  }

  /// Bands of gold with studs, and a ball on top.
  void ornaments(RibText& rib, double radius, double height) const {
    rib.add("Surface \"metal\" \"Ka\" [1.5] \"Ks\" [1.4] \"roughness\" [0.12]");
    rib.add("Color [0.95 0.7 0.3]");
    rib.add("TransformBegin Translate 0 0 {} Sphere {r} -{r} {r} 360 TransformEnd",
            height + 1.9 * radius, fmt::arg("r", radius));
    for (const double level : {0.25, 0.62, 0.93}) {
      rib.add("TransformBegin Translate 0 0 {}", level * height);
      rib.add("Torus {} {} 0 360 360", radius, radius * 0.12);
      for (int k = 0; k < 9; ++k)
        rib.add(
            "TransformBegin Rotate {} 0 0 1 Translate {} 0 {} Sphere {r} -{r} {r} 360 "
            "TransformEnd",
            40 * k, radius, radius * 0.4, fmt::arg("r", radius * 0.17));
      rib.add("TransformEnd");
    }
  }

  ShadingSceneRequest request_;
};

}  // namespace tessera
