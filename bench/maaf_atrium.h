#pragma once
/// A courtyard of two floors under an opening in its roof: columns, arches, balustrades, cloths
/// that hang across. Most of it is lit by what other walls give back.

#include "bench/maaf_rib.h"

namespace tessera {

class Atrium {
 public:
  explicit Atrium(const MaafSceneRequest& request) : request_(request) {}

  std::string text() const {
    MaafRib rib(request_);
    rib.view({{-1.25, 2.3, -0.9}, {0.4, 3.3, 9}}, 58, 0.13, 9);
    rib.add("WorldBegin");
    rib.rectangle_light(1, {0, roof + 0.3, bay * bays / 2}, {0, -1, 0}, 5.4, bay * bays - 3, 5,
                        {1, 0.95, 0.86});
    rib.bounce(2, 0.4);
    shell(rib);
    roof_rim(rib);
    for (int k = 0; k <= bays; ++k)
      for (const double side : {-1.0, 1.0}) {
        column(rib, {side * court, 0, bay * k}, 0.3, floor_height - 1.25);
        column(rib, {side * court, floor_height + 0.02, bay * k}, 0.2, 2.0);
      }
    for (int k = 0; k < bays; ++k)
      for (const double side : {-1.0, 1.0}) {
        arch(rib, side, k, 0, floor_height - 1.25, 0.32);
        arch(rib, side, k, floor_height, 2.0, 0.24);
        balustrade(rib, {side * court, floor_height, bay * k}, {0, 0, bay});
      }
    for (int k = 0; k < 2; ++k)
      balustrade(rib, {court * (k - 1), floor_height, bay * bays}, {court, 0, 0});
    for (int k = 0; k < 4; ++k) cloth(rib, k);
    pots(rib);
    fountain(rib);
    rib.add("WorldEnd");
    return rib.text();
  }

 private:
  static constexpr double court = 3, aisle = 2.2;  ///< half width of the court; of an aisle
  static constexpr double bay = 2.6, floor_height = 4.2, roof = 7.6;
  static constexpr int bays = 6;
  static constexpr double wall = court + aisle, back = bay * bays + 1.6, front = -3;

  void shell(MaafRib& rib) const {
    rib.attribute([&] {
      rib.checker({0.62, 0.55, 0.46}, {0.5, 0.42, 0.34}, 1);
      rib.quad({-wall, 0, front}, {2 * wall, 0, 0}, {0, 0, back - front}, {14, 26});
      for (const double side : {-1.0, 1.0}) {
        rib.matte(side < 0 ? Albedo(0.76, 0.6, 0.42) : Albedo(0.74, 0.52, 0.4));
        rib.quad({side * wall, 0, front}, {0, 0, back - front}, {0, roof, 0});
        rib.matte({0.7, 0.63, 0.52});  // the upper floor, its underside, the roof of the aisle
        const double width = aisle + 0.25, x = side * (court - 0.25 + width / 2);
        rib.block({x, floor_height - 0.14, (front + back) / 2},
                  {width / 2, 0.14, (back - front) / 2});
        rib.block({x, roof + 0.05, (front + back) / 2}, {width / 2, 0.12, (back - front) / 2});
      }
      rib.matte({0.76, 0.66, 0.52});
      rib.quad({-wall, 0, back}, {2 * wall, 0, 0}, {0, roof, 0});
      rib.quad({-wall, 0, front}, {2 * wall, 0, 0}, {0, roof, 0});
      rib.block({0, floor_height - 0.14, bay * bays + 0.8}, {court, 0.14, 1.0});
    });
    doors(rib);
  }

  void doors(MaafRib& rib) const {
    for (int k = 0; k < bays; ++k)
      for (const double side : {-1.0, 1.0})
        for (const double y : {0.0, floor_height})
          rib.attribute([&] {
            const double z = bay * (k + 0.5);
            rib.matte({0.2, 0.3, 0.32});
            rib.block({side * (wall - 0.03), y + 1.1, z}, {0.03, 1.1, 0.5});
            rib.matte({0.6, 0.5, 0.38});
            for (const double d : {-0.56, 0.56})
              rib.block({side * (wall - 0.05), y + 1.15, z + d}, {0.06, 1.15, 0.07});
            rib.pillow({side * (wall - 0.06), y + 2.34, z}, {0.08, 0.08, 0.7}, 0.04);
          });
    rib.attribute([&] {
      rib.matte({0.3, 0.16, 0.1});
      rib.block({0, 1.4, back - 0.04}, {1, 1.4, 0.04});
      rib.matte({0.62, 0.52, 0.4});
      for (const double x : {-1.12, 1.12})
        rib.pillow({x, 1.45, back - 0.1}, {0.12, 1.45, 0.1}, 0.05);
      rib.pillow({0, 2.98, back - 0.1}, {1.4, 0.12, 0.14}, 0.06);
    });
  }

  /// Around the opening, beams across it, the sky above the light.
  void roof_rim(MaafRib& rib) const {
    rib.attribute([&] {
      rib.glow({0.8, 0.95, 1.15});
      rib.quad({-8, roof + 1, -8}, {16, 0, 0}, {0, 0, 32});
    });
    rib.attribute([&] {
      rib.matte({0.45, 0.33, 0.22});
      for (int k = 0; k <= 2 * bays; ++k)
        rib.block({0, roof - 0.02, bay * 0.5 * k}, {court, 0.07, 0.05});
      rib.matte({0.72, 0.64, 0.53});
      rib.block({0, roof + 0.05, back - 0.9}, {court, 0.12, 1.1});
      rib.block({0, roof + 0.05, front / 2 - 0.3}, {court, 0.12, 1.4});
    });
  }

  void column(MaafRib& rib, const glm::dvec3& foot, double radius, double height) const {
    rib.attribute([&] {
      rib.matte({0.74, 0.68, 0.58});
      const double r = radius;
      rib.block(foot + glm::dvec3(0, 0.3 * r, 0), {1.3 * r, 0.3 * r, 1.3 * r});
      rib.turned(foot, {{1.2 * r, 0.6 * r},
                        {1.25 * r, 0.75 * r},
                        {1.05 * r, 0.95 * r},
                        {0.9 * r, 1.2 * r},
                        {0.86 * r, 0.4 * height},
                        {0.72 * r, height - 1.2 * r},
                        {0.72 * r, height - r},
                        {0.95 * r, height - 0.8 * r},
                        {1.2 * r, height - 0.4 * r}});
      rib.ring(foot + glm::dvec3(0, height - 1.3 * r, 0), 0.74 * r, 0.07 * r);
      rib.block(foot + glm::dvec3(0, height - 0.2 * r, 0), {1.3 * r, 0.2 * r, 1.3 * r});
    });
  }

  /// Between the columns k and k + 1 of a side: half a round opening in a wall up to the next
  /// floor.
  void arch(MaafRib& rib, double side, int k, double base, double spring, double thick) const {
    const double top = base > 0 ? roof : floor_height - 0.28;
    const double radius = 0.5 * bay - thick * 0.9, z = bay * (k + 0.5), x = side * court;
    constexpr int steps = 16;
    const auto on_arc = [&](int j) {
      const double a = std::numbers::pi * j / steps;
      return glm::dvec2(z - radius * std::cos(a), base + spring + radius * std::sin(a) * 0.9);
    };
    const auto outer = [&](int j) {
      return glm::dvec2(j == 0       ? z - bay / 2
                        : j == steps ? z + bay / 2
                                     : glm::mix(z - bay / 2, z + bay / 2, double(j) / steps),
                        top);
    };
    rib.attribute([&] {
      rib.matte({0.72, 0.63, 0.5});
      for (const double face : {-0.5, 0.5})  // the two faces of the wall
        for (int j = 0; j < steps; ++j) {
          const glm::dvec2 a = on_arc(j), b = on_arc(j + 1), c = outer(j), d = outer(j + 1);
          const double X = x + face * thick;
          rib.add(
              "Polygon \"P\" [{:.5g} {:.5g} {:.5g}  {:.5g} {:.5g} {:.5g}  "
              "{:.5g} {:.5g} {:.5g}  {:.5g} {:.5g} {:.5g}]",
              X, a.y, a.x, X, b.y, b.x, X, d.y, d.x, X, c.y, c.x);
        }
      for (const double s : {-1.0, 1.0})
        rib.block({x, (base + spring + top) / 2, z + s * (bay / 2 - 0.45 * thick)},
                  {thick / 2, (top - base - spring) / 2, 0.45 * thick});
      rib.matte({0.66, 0.55, 0.42});
      rib.sheet({2, steps + 1}, [&](int i, int j) {
        const glm::dvec2 p = on_arc(j);
        return glm::dvec3(x + (i - 0.5) * (thick + 0.06), p.y, p.x);
      });
      for (const double face : {-0.5, 0.5}) {  // a moulding along the arc
        std::vector<glm::dvec3> path;
        for (int j = 0; j <= steps; ++j)
          path.emplace_back(x + face * (thick + 0.04), on_arc(j).y + 0.04, on_arc(j).x);
        rib.tube(path, [](double) { return 0.045; });
      }
    });
  }

  void balustrade(MaafRib& rib, const glm::dvec3& from, const glm::dvec3& along) const {
    rib.attribute([&] {
      rib.matte({0.72, 0.66, 0.57});
      constexpr int count = 9;
      for (int k = 0; k < count; ++k)
        rib.turned(from + along * ((k + 0.5) / count), {{0.075, 0.06},
                                                        {0.07, 0.09},
                                                        {0.035, 0.12},
                                                        {0.07, 0.26},
                                                        {0.065, 0.34},
                                                        {0.03, 0.58},
                                                        {0.03, 0.66},
                                                        {0.065, 0.7},
                                                        {0.07, 0.76}});
      const glm::dvec3 half = 0.5 * along + 0.09 * glm::dvec3(along.x ? 0 : 1, 0, along.z ? 0 : 1);
      rib.block(from + 0.5 * along + glm::dvec3(0, 0.03, 0), half + glm::dvec3(0, 0.03, 0));
      rib.pillow(from + 0.5 * along + glm::dvec3(0, 0.81, 0), half + glm::dvec3(0.03, 0.05, 0.03),
                 0.03);
    });
  }

  /// Hangs over the court in waves.
  void cloth(MaafRib& rib, int k) const {
    const Albedo colors[] = {
        {0.65, 0.13, 0.1}, {0.13, 0.38, 0.34}, {0.72, 0.5, 0.12}, {0.2, 0.22, 0.48}};
    const double side = k % 2 ? 1 : -1, z = 3.9 + 2.7 * k;
    rib.attribute([&] {
      rib.matte(colors[k]);
      rib.sheet({12, 22}, [&](int i, int j) {
        const double s = i / 11.0, t = j / 21.0;
        const double wave = 0.1 * std::sin(13 * s + 2 * k + 3 * t) * (0.3 + t);
        return glm::dvec3(side * 1.4 + 1.5 * (s - 0.5) + 0.04 * std::sin(9 * t),
                          roof - 0.1 - 3.9 * t + 0.15 * std::sin(3 * s + k),
                          z + 0.3 * std::sin(2.5 * t + k) + wave);
      });
      rib.matte({0.35, 0.25, 0.15});
      rib.rod({side * 1.4 - 0.8, roof - 0.09, z}, {side * 1.4 + 0.8, roof - 0.09, z}, 0.03, 0.03);
    });
    rib.attribute([&] {  // a garland from side to side
      rib.matte(colors[(k + 2) % 4]);
      std::vector<glm::dvec3> path;
      for (int j = 0; j < 15; ++j) {
        const double s = j / 7.0 - 1;
        path.emplace_back(court * s, floor_height + 0.4 + 1.3 * s * s, bay * (k + 1));
      }
      rib.tube(path, [](double) { return 0.018; });
      for (int j = 1; j < 14; ++j)
        rib.add("Polygon \"P\" [{} {} {z}  {} {} {z}  {} {} {z}]", path[size_t(j)].x - 0.12,
                path[size_t(j)].y, path[size_t(j)].x + 0.12, path[size_t(j)].y, path[size_t(j)].x,
                path[size_t(j)].y - 0.32, fmt::arg("z", path[size_t(j)].z));
    });
  }

  void pots(MaafRib& rib) const {
    for (int k = 0; k < 6; ++k) {
      const glm::dvec3 foot((k % 2 ? 1 : -1) * (court - 0.75), 0, 2.2 + 2.1 * k);
      rib.attribute([&] {
        rib.matte({0.6, 0.3, 0.18});
        rib.turned(foot, {{0, 0.01},
                          {0.16, 0.01},
                          {0.2, 0.1},
                          {0.3, 0.4},
                          {0.29, 0.5},
                          {0.33, 0.52},
                          {0.33, 0.58},
                          {0.27, 0.58},
                          {0.26, 0.48},
                          {0, 0.46}});
        rib.matte({0.18, 0.34, 0.12});
        for (int l = 0; l < 14; ++l) frond(rib, foot + glm::dvec3(0, 0.46, 0), l);
      });
    }
  }

  void frond(MaafRib& rib, const glm::dvec3& root, int l) const {
    const double a = 2.4 * l, reach = 0.35 + 0.3 * MaafRib::pick(l, 4), rise = 1.1 - 0.04 * l;
    const glm::dvec3 out(std::cos(a), 0, std::sin(a)), aside(-out.z, 0, out.x);
    rib.sheet({3, 6}, [&](int i, int j) {
      const double s = j / 5.0, half = 0.055 * std::sin(std::numbers::pi * (0.12 + 0.85 * s));
      return root + reach * s * out + (i - 1) * half * aside +
             glm::dvec3(0, rise * s - 0.55 * s * s * s + (i == 1 ? -0.015 : 0), 0);
    });
  }

  void fountain(MaafRib& rib) const {
    rib.attribute([&] {
      rib.matte({0.68, 0.64, 0.58});
      rib.turned({0.2, 0, 8.2}, {{1.15, 0},
                                 {1.2, 0.1},
                                 {1.1, 0.2},
                                 {1.15, 0.5},
                                 {1.25, 0.55},
                                 {1.25, 0.62},
                                 {1.05, 0.62},
                                 {1.0, 0.5},
                                 {1.0, 0.15},
                                 {0, 0.15}});
      rib.turned({0.2, 0, 8.2}, {{0.3, 0.1},
                                 {0.14, 0.3},
                                 {0.1, 0.7},
                                 {0.2, 0.95},
                                 {0.6, 1.15},
                                 {0.62, 1.2},
                                 {0.56, 1.2},
                                 {0.1, 1.08},
                                 {0.06, 1.45},
                                 {0, 1.5}});
      rib.matte({0.2, 0.32, 0.36});
      rib.disk({0.2, 0.5, 8.2}, 1.03);
    });
  }

  MaafSceneRequest request_;
};

}  // namespace tessera
