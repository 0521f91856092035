#pragma once
/// A meeting room under two light panels: a long table in focus, chairs with thin legs and slats
/// before and behind it, a door, a window with blinds.

#include "bench/maaf_rib.h"

namespace tessera {

class Conference {
 public:
  explicit Conference(const MaafSceneRequest& request) : request_(request) {}

  std::string text() const {
    MaafRib rib(request_);
    rib.view({{-2.45, 1.75, 0.75}, {0.35, 0.72, 5.0}}, 44, 0.055, 3.6);
    rib.add("WorldBegin");
    int handle = 1;
    for (const double z : panel_places)
      rib.rectangle_light(handle++, {0, height - 0.05, z}, {0, -1, 0}, panel_half.x * 2,
                          panel_half.z * 2, 9, {1, 0.96, 0.88});
    rib.bounce(handle, 0.35);
    shell(rib);
    ceiling(rib);
    door(rib);
    window(rib);
    table(rib);
    for (int k = 0; k < 5; ++k) {
      const double z = 3.1 + 1.05 * k;
      chair(rib, {-1.15 - 0.25 * MaafRib::pick(k, 1), 0, z}, -90 + turn(k, 2));
      chair(rib, {1.15 + 0.25 * MaafRib::pick(k, 3), 0, z}, 90 + turn(k, 4));
    }
    chair(rib, {0.1, 0, 8.5}, 8);
    chair(rib, {-0.35, 0, 1.95}, 158);
    rib.add("WorldEnd");
    return rib.text();
  }

 private:
  static constexpr double half_width = 3.3, length = 10.5, height = 2.9;
  static constexpr double panel_places[] = {3.6, 6.8};
  static inline const glm::dvec3 panel_half{0.9, 0, 0.55}, table_center{0, 0, 5.2};
  static constexpr double table_top = 0.75;

  /// Of a chair that nobody has straightened.
  static double turn(int k, int seed) { return 40 * (MaafRib::pick(k, seed) - 0.5); }

  void shell(MaafRib& rib) const {
    rib.attribute([&] {
      rib.checker({0.5, 0.42, 0.34}, {0.4, 0.33, 0.27}, 1);
      rib.quad({-half_width, 0, 0}, {2 * half_width, 0, 0}, {0, 0, length}, {11, 17});
      rib.matte({0.75, 0.73, 0.68});
      rib.quad({-half_width, height, length}, {2 * half_width, 0, 0}, {0, -height, 0});
      rib.quad({-half_width, height, 0}, {2 * half_width, 0, 0}, {0, -height, 0});
      rib.matte({0.62, 0.68, 0.7});
      rib.quad({-half_width, height, 0}, {0, 0, length}, {0, -height, 0});
      rib.matte({0.8, 0.62, 0.42});
      rib.quad({half_width, height, 0}, {0, 0, length}, {0, -height, 0});
      rib.matte({0.3, 0.24, 0.2});  // skirting
      for (const double side : {-1.0, 1.0})
        rib.block({side * (half_width - 0.01), 0.05, length / 2}, {0.012, 0.05, length / 2});
      rib.block({0, 0.05, length - 0.01}, {half_width, 0.05, 0.012});
    });
  }

  /// Beams in a grid, and the panels between them: each shines as the light below it does.
  void ceiling(MaafRib& rib) const {
    rib.attribute([&] {
      rib.matte({0.85, 0.84, 0.8});
      rib.quad({-half_width, height, 0}, {2 * half_width, 0, 0}, {0, 0, length});
      for (const double x : {-2.2, -1.1, 1.1, 2.2})
        rib.block({x, height - 0.02, length / 2}, {0.03, 0.02, length / 2});
      for (double z = 1.2; z < length; z += 1.6)
        rib.block({0, height - 0.021, z}, {half_width, 0.02, 0.03});
    });
    rib.attribute([&] {
      rib.glow({1, 0.97, 0.9});
      for (const double z : panel_places)
        rib.quad({-panel_half.x, height - 0.045, z - panel_half.z}, {2 * panel_half.x, 0, 0},
                 {0, 0, 2 * panel_half.z});
    });
  }

  void door(MaafRib& rib) const {
    const double z = length - 0.02;
    rib.attribute([&] {
      rib.matte({0.85, 0.82, 0.76});
      for (const double x : {-2.55, -1.55}) rib.block({x, 1.05, z}, {0.05, 1.05, 0.04});
      rib.block({-2.05, 2.12, z}, {0.55, 0.05, 0.04});
      rib.matte({0.35, 0.16, 0.09});
      rib.block({-2.05, 1.03, z}, {0.45, 1.03, 0.02});
      rib.matte({0.42, 0.2, 0.12});
      for (const double y : {0.55, 1.5})
        for (const double x : {-2.25, -1.85})
          rib.pillow({x, y, z - 0.025}, {0.15, 0.35, 0.02}, 0.03);
      rib.matte({0.7, 0.6, 0.3});
      rib.ball({-1.67, 1.02, z - 0.07}, {0.035, 0.035, 0.035});
      rib.rod({-1.67, 1.02, z}, {-1.67, 1.02, z - 0.07}, 0.012, 0.012);
    });
    for (const double x : {-0.2, 0.9, 2.0})  // pictures
      rib.attribute([&] {
        rib.matte({0.12, 0.1, 0.1});
        rib.block({x, 1.65, z}, {0.42, 0.34, 0.025});
        rib.checker({0.75, 0.35 + 0.15 * x, 0.2}, {0.2, 0.35, 0.5 - 0.1 * x}, 1);
        rib.quad({x - 0.36, 1.93, z - 0.027}, {0.72, 0, 0}, {0, -0.56, 0}, {4 + x, 3});
      });
  }

  /// In the right wall, a sky behind it and blinds before it.
  void window(MaafRib& rib) const {
    const double x = half_width, z0 = 4.2, z1 = 8.2, low = 0.9, high = 2.4;
    rib.attribute([&] {
      rib.glow({0.5, 0.62, 0.75});
      rib.quad({x - 0.01, high, z0}, {0, 0, z1 - z0}, {0, low - high, 0});
      rib.matte({0.85, 0.83, 0.8});
      for (const double z : {z0, 0.5 * (z0 + z1), z1})
        rib.block({x - 0.03, 0.5 * (low + high), z}, {0.03, 0.5 * (high - low), 0.04});
      rib.block({x - 0.07, low - 0.02, 0.5 * (z0 + z1)}, {0.09, 0.025, 0.5 * (z1 - z0) + 0.1});
      rib.block({x - 0.05, high + 0.05, 0.5 * (z0 + z1)}, {0.06, 0.05, 0.5 * (z1 - z0) + 0.05});
    });
    constexpr int slats = 30;
    for (int k = 0; k < slats; ++k)
      rib.attribute([&] {
        rib.matte({0.8, 0.72, 0.6});
        rib.add("Translate {} {:.5g} {} Rotate -32 0 0 1", x - 0.12,
                glm::mix(low + 0.03, high - 0.03, double(k) / (slats - 1)), 0.5 * (z0 + z1));
        rib.block({0, 0, 0}, {0.022, 0.0012, 0.5 * (z1 - z0) - 0.03});
      });
    rib.attribute([&] {
      rib.matte({0.8, 0.78, 0.7});
      for (const double z : {z0 + 0.5, 0.5 * (z0 + z1) - 0.1, z1 - 0.5})
        rib.rod({x - 0.145, low, z}, {x - 0.145, high, z}, 0.002, 0.002);
    });
  }

  void table(MaafRib& rib) const {
    rib.attribute([&] {
      rib.matte({0.45, 0.25, 0.13});
      rib.pillow({0, table_top - 0.025, table_center.z}, {0.75, 0.028, 2.7}, 0.3);
      rib.matte({0.25, 0.2, 0.18});
      for (const double z : {-1.6, 1.6}) {
        rib.turned({0, 0, table_center.z + z}, {{0, 0},
                                                {0.42, 0},
                                                {0.42, 0.03},
                                                {0.12, 0.08},
                                                {0.08, 0.3},
                                                {0.08, 0.6},
                                                {0.3, 0.71},
                                                {0, 0.72}});
      }
      rib.block({0, 0.62, table_center.z}, {0.03, 0.05, 1.6});
    });
    for (int k = 0; k < 9; ++k) {  // sheets of paper, each bent a little
      const double side = k % 2 ? 1 : -1;
      rib.placed({side * (0.42 + 0.1 * MaafRib::pick(k, 7)), table_top + 0.006, 3.0 + 0.52 * k},
                 30 * (MaafRib::pick(k, 8) - 0.5), [&] {
                   rib.matte({0.85, 0.84, 0.8});
                   rib.sheet({4, 5}, [&](int i, int j) {
                     return glm::dvec3(0.07 * (i - 1.5),
                                       (i == 3 && j == 0) ? 0.05 : 0.004 * (j % 3),
                                       0.074 * (j - 2));
                   });
                 });
    }
    for (int k = 0; k < 5; ++k) mug(rib, k);
    for (int k = 0; k < 2; ++k) laptop(rib, k);
    fruit_bowl(rib);
    rib.attribute([&] {
      for (int k = 0; k < 7; ++k) {  // pencils
        rib.matte({0.75, 0.15 + 0.1 * k, 0.1});
        const double angle = 6 * MaafRib::pick(k, 12), z = 3.2 + 0.6 * k;
        const glm::dvec3 a((k % 2 ? -0.2 : 0.25), table_top + 0.008, z);
        rib.rod(a, a + 0.17 * glm::dvec3(std::cos(angle), 0, std::sin(angle)), 0.005, 0.005);
      }
    });
  }

  void mug(MaafRib& rib, int k) const {
    const Albedo colors[] = {{0.75, 0.2, 0.12}, {0.15, 0.35, 0.6}, {0.8, 0.75, 0.6}};
    rib.placed({k % 2 ? 0.3 : -0.34, table_top, 3.05 + 0.95 * k}, 70.0 * k, [&] {
      rib.matte(colors[k % 3]);
      rib.turned({0, 0, 0}, {{0, 0.002},
                             {0.037, 0.002},
                             {0.041, 0.01},
                             {0.041, 0.09},
                             {0.041, 0.1},
                             {0.036, 0.1},
                             {0.036, 0.09},
                             {0.036, 0.012},
                             {0, 0.012}});
      rib.add("TransformBegin Translate 0.045 0.052 0 Torus 0.025 0.006 0 360 360 TransformEnd");
    });
  }

  void laptop(MaafRib& rib, int k) const {
    rib.placed({k ? 0.36 : -0.33, table_top + 0.01, k ? 5.75 : 4.35}, k ? 80 : -100, [&] {
      rib.matte({0.4, 0.41, 0.43});
      rib.pillow({0, 0, 0}, {0.17, 0.009, 0.12}, 0.006);
      rib.matte({0.08, 0.08, 0.09});
      rib.block({0, 0.009, 0.03}, {0.15, 0.002, 0.06});
      rib.add("Translate 0 0.01 0.12 Rotate -18 1 0 0");
      rib.matte({0.4, 0.41, 0.43});
      rib.pillow({0, 0.11, 0}, {0.17, 0.11, 0.005}, 0.004);
      rib.glow({0.3, 0.38, 0.5});
      rib.quad({-0.155, 0.205, -0.0055}, {0.31, 0, 0}, {0, -0.19, 0});
    });
  }

  void fruit_bowl(MaafRib& rib) const {
    rib.placed({0, table_top, 5.0}, 0, [&] {
      rib.matte({0.3, 0.45, 0.5});
      rib.turned({0, 0, 0}, {{0, 0.003},
                             {0.06, 0.003},
                             {0.07, 0.02},
                             {0.13, 0.05},
                             {0.17, 0.1},
                             {0.165, 0.103},
                             {0.12, 0.06},
                             {0, 0.03}});
      for (int k = 0; k < 6; ++k) {
        rib.matte(k % 2 ? Albedo(0.8, 0.4, 0.06) : Albedo(0.65, 0.12, 0.08));
        rib.ball({0.08 * std::cos(1.2 * k), 0.1, 0.08 * std::sin(1.2 * k)}, {0.045, 0.043, 0.045});
      }
    });
  }

  /// Faces +z of its own space: the back is at -z.
  void chair(MaafRib& rib, const glm::dvec3& place, double turn_degrees) const {
    rib.placed(place, turn_degrees + 180, [&] {
      rib.matte({0.5, 0.3, 0.15});
      const double w = 0.21, d = 0.2, seat = 0.45, top = 0.98, lean = 0.09;
      for (const double side : {-1.0, 1.0}) {
        rib.rod({side * (w + 0.02), 0, d + 0.03}, {side * w, seat, d}, 0.013, 0.018);
        rib.rod({side * (w + 0.02), 0, -d - 0.06}, {side * w, seat, -d}, 0.013, 0.018);
        rib.rod({side * w, seat, -d}, {side * w, top, -d - lean}, 0.016, 0.013);
        rib.ball({side * w, top, -d - lean}, {0.02, 0.02, 0.02});
        rib.rod({side * (w + 0.012), 0.2, d + 0.02}, {side * (w + 0.012), 0.2, -d - 0.04}, 0.009,
                0.009);
      }
      rib.rod({-w, 0.22, 0}, {w, 0.22, 0}, 0.009, 0.009);
      for (int k = 0; k < 5; ++k)  // upright slats
        rib.rod({-0.14 + 0.07 * k, seat + 0.1, -d - 0.02}, {-0.14 + 0.07 * k, 0.9, -d - 0.078},
                0.009, 0.009);
      for (const double y : {0.1, 0.45, 0.5})
        rib.pillow({0, seat + y, -d - lean * y / (top - seat)}, {w, 0.02, 0.009}, 0.006);
      rib.matte({0.2, 0.3, 0.36});
      rib.pillow({0, seat + 0.01, 0}, {w + 0.03, 0.035, d + 0.04}, 0.05);
    });
  }

  MaafSceneRequest request_;
};

}  // namespace tessera
