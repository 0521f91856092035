#pragma once
/// A fast flight along the street of a citadel: brick walls and signboards pass at close range,
/// towers stand at its end.

#include <iterator>

#include "bench/shading_rib.h"
#include "bench/shading_textures.h"

namespace tessera {

class Flythrough {
 public:
  explicit Flythrough(const ShadingSceneRequest& request) : request_(request) {}

  std::string text() const {
    RibText rib;
    rib.options(request_, 46, 0.09, 22);
    rib.camera(
        [](double time) {
          return CameraPose{{0.6 + 0.1 * time, 2.5, 1.1 * time},
                            {0.2 + 0.3 * time, 3.6, 24 + 1.1 * time},
                            2 + 0.4 * time};
        },
        request_.motion);
    rib.add("WorldBegin");
    add_daylight(rib, 0.3, 0.8);
    rib.add(
        "LightSource \"spotlight\" 4 \"intensity\" [75] \"lightcolor\" [1 0.75 0.45] "
        "\"from\" [-2 13 12] \"to\" [1 0 26] \"coneangle\" [0.6] \"conedeltaangle\" [0.3]");
    sky_and_ground(rib);
    for (const double side : {-1.0, 1.0})
      for (int k = 0; k < houses; ++k) house(rib, side, k);
    arches(rib);
    citadel(rib);
    rib.add("WorldEnd");
    return rib.text();
  }

 private:
  static constexpr int houses = 7;
  static constexpr double house_length = 8, street_half = 4.6;

  void paint(RibText& rib, const std::string& texture, double Ks = 0.15) const {
    rib.add(
        "Surface \"paintedplastic\" \"Ks\" [{}] \"Kd\" [0.8] \"string texturename\" "
        "[\"{}/{}.exr\"]",
        Ks, request_.textures, texture);
  }

  void sky_and_ground(RibText& rib) const {
    rib.attribute([&] {
      rib.add("Surface \"constant\"");
      rib.add(
          "Polygon \"P\" [-400 -20 240  -400 220 240  400 220 240  400 -20 240] "
          "\"Cs\" [0.85 0.72 0.58  0.2 0.33 0.56  0.2 0.33 0.56  0.85 0.72 0.58]");
    });
    rib.attribute([&] {
      paint(rib, "paving", 0.3);
      rib.quad({-12, 0, -6}, {24, 0, 0}, {0, 0, 110}, {8, 36});
    });
  }

  void house(RibText& rib, double side, int k) const {
    const double z0 = 1 + house_length * k, height = 6 + 1.5 * ((k * 5 + (side > 0 ? 3 : 0)) % 4);
    const double x = side * street_half;
    rib.attribute([&] {
      const double tone = 0.85 + 0.1 * (k % 3);
      rib.add("Color [{} {} {}]", tone, tone * (k % 2 ? 0.95 : 1.0), tone);
      paint(rib, k % 3 == 1 ? "wall" : "brick");
      rib.quad({x, height, z0}, {0, 0, house_length - 0.4}, {0, -height, 0}, {2.5, height / 3.2});
      rib.quad({x, height, z0}, {side * 6, 0, 0}, {0, -height, 0}, {2, height / 3.2});
      rib.quad({x, height, z0 + house_length - 0.4}, {side * 6, 0, 0}, {0, -height, 0},
               {2, height / 3.2});
      rib.add("Surface \"matte\" Color [0.3 0.12 0.08]");
      rib.quad({x - 0.3 * side, height, z0 - 0.2}, {0, 0, house_length}, {side * 3, 2.2, 0});
    });
    for (int w = 0; w < 3; ++w) window(rib, side, x, 3.3 + 0.4 * (k % 2), z0 + 1.4 + 2.4 * w);
    if (k % 2 == (side > 0)) awning(rib, side, x, z0 + 2.5);
    board(rib, side, k, x, z0 + 0.7);
    lantern(rib, side, x, z0 + 5.9);
  }

  void window(RibText& rib, double side, double x, double y, double z) const {
    rib.attribute([&] {
      rib.add("Surface \"plastic\" \"Ks\" [0.3] Color [0.6 0.55 0.45]");
      rib.box({x - 0.06 * side, y, z}, {0.1, 0.8, 0.55});
      rib.add("Surface \"plastic\" \"Ks\" [0.9] \"roughness\" [0.03] Color [0.06 0.08 0.12]");
      for (int pane = 0; pane < 4; ++pane)
        rib.box({x - 0.16 * side, y - 0.36 + 0.72 * (pane / 2), z - 0.24 + 0.48 * (pane % 2)},
                {0.03, 0.31, 0.19});
    });
  }

  void awning(RibText& rib, double side, double x, double z) const {
    rib.attribute([&] {
      paint(rib, "cloth", 0.05);
      rib.sheet({9, 4, false, {3, 1}}, [&](int i, int j) {
        return glm::dvec3(x - side * 0.45 * j, 2.5 - 0.17 * j * j * 0.5 - 0.06 * (i % 2) * j,
                          z + 0.45 * i);
      });
    });
  }

  /// Hangs across the pavement from an iron bar.
  void board(RibText& rib, double side, int k, double x, double z) const {
    const size_t word = size_t(k * 2 + (side > 0)) % std::size(shading_board_words);
    const double wide = 2.3, high = 1.2, y = 4.6 + 0.35 * (k % 3);
    rib.attribute([&] {
      rib.add("Surface \"metal\" \"roughness\" [0.15] Color [0.35 0.35 0.38]");
      rib.add(
          "TransformBegin Translate {} {} {} Rotate {} 0 1 0 Cylinder 0.05 0 {} 360 "
          "TransformEnd",
          x, y + 0.12, z, -90 * side, wide + 0.4);
      paint(rib, fmt::format("board_{}", shading_board_words[word]), 0.1);
      const double left = side > 0 ? x - wide - 0.25 : x + 0.25;
      rib.quad({left, y, z}, {wide, 0, 0}, {0, -high, 0});
    });
  }

  void lantern(RibText& rib, double side, double x, double z) const {
    rib.attribute([&] {
      rib.add("Translate {} 2.9 {}", x - 0.45 * side, z);
      rib.add("Surface \"constant\" Color [1.1 0.8 0.4]");
      rib.add("Sphere 0.16 -0.16 0.16 360");
      rib.add("Surface \"metal\" \"Ks\" [1.4] \"roughness\" [0.1] Color [0.8 0.6 0.3]");
      rib.add("Rotate -90 1 0 0 Translate 0 0 0.1 Cone 0.3 0.26 360");
      rib.add("Translate 0 0 -0.3 Torus 0.16 0.04 0 360 360");
    });
  }

  /// Across the street, over the heads.
  void arches(RibText& rib) const {
    for (const double z : {20.0, 37.0})
      rib.attribute([&] {
        paint(rib, "wall");
        constexpr int around = 13;
        for (const int part : {0, 1, 2})  // underside, front, top
          rib.sheet({around, 2, false, {4, 0.6}}, [&](int i, int j) {
            const double angle = std::numbers::pi * i / (around - 1);
            const double inner = street_half, outer = street_half + 0.9;
            const double r = part == 0 ? inner : part == 2 ? outer : j ? outer : inner;
            const double depth = part == 1 ? 0 : 1.1 * j;
            return glm::dvec3(r * std::cos(angle), 3.4 + 0.75 * r * std::sin(angle), z + depth);
          });
      });
  }

  void citadel(RibText& rib) const {
    rib.attribute([&] {
      paint(rib, "wall");
      rib.quad({-30, 13, 66}, {60, 0, 0}, {0, -13, 0}, {14, 3.5});
      rib.add("TextureCoordinates [0 5 4 5 0 0 4 0]");
      for (const double x : {-9.0, 0.5, 10.0}) {
        const double height = x == 0.5 ? 30 : 21;
        rib.add(
            "TransformBegin Translate {} 0 63 Rotate -90 1 0 0 Cylinder 3.2 0 {} 360 "
            "Translate 0 0 {} Torus 3.3 0.4 0 360 360 TransformEnd",
            x, height, height);
      }
    });
    rib.attribute([&] {
      rib.add("Surface \"marble\" \"frequency\" [0.5] Color [0.35 0.42 0.6]");
      for (const double x : {-9.0, 0.5, 10.0})
        rib.add("TransformBegin Translate {} {} 63 Rotate -90 1 0 0 Cone 7 3.9 360 TransformEnd", x,
                x == 0.5 ? 30 : 21);
    });
  }

  ShadingSceneRequest request_;
};

}  // namespace tessera
