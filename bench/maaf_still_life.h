#pragma once
/// A laid table close to the camera under one round lamp: a bowl of fruit in focus, flowers,
/// bottles and a candlestick before and behind it, far out of focus.

#include "bench/maaf_bouquet.h"

namespace tessera {

class StillLife {
 public:
  explicit StillLife(const MaafSceneRequest& request) : request_(request) {}

  std::string text() const {
    MaafRib rib(request_);
    rib.view({{0.1, 0.5, -1.12}, {0.0, 0.165, 0.05}}, 36, 0.036, 1.2);
    rib.add("WorldBegin");
    rib.sphere_light(1, {-0.95, 1.15, -0.35}, 0.2, 50, {1, 0.93, 0.82});
    rib.bounce(2, 0.3);
    room(rib);
    cloth(rib);
    fruit_bowl(rib);
    Bouquet::add(rib, {-0.34, 0, 0.22});
    bottle(rib, {0.36, 0, 0.42}, 1.0, {0.12, 0.3, 0.16});
    bottle(rib, {0.52, 0, 0.62}, 1.15, {0.45, 0.2, 0.08});
    bottle(rib, {0.22, 0, 0.68}, 0.9, {0.6, 0.55, 0.42});
    cup(rib, {0.3, 0, -0.2}, 35);
    cup(rib, {-0.28, 0, -0.36}, 160);
    pears(rib);
    grapes(rib);
    candlestick(rib, {-0.12, 0, 0.5});
    books(rib);
    knife(rib);
    rib.add("WorldEnd");
    return rib.text();
  }

 private:
  void room(MaafRib& rib) const {
    rib.attribute([&] {
      rib.matte({0.55, 0.42, 0.3});
      rib.quad({-3, 2.4, 1.35}, {6, 0, 0}, {0, -3.4, 0});
      rib.matte({0.55, 0.22, 0.16});
      rib.quad({1.5, 2.4, 1.35}, {0, 0, -4.5}, {0, -3.4, 0});
      rib.matte({0.35, 0.42, 0.5});
      rib.quad({-2.2, 2.4, -3.1}, {0, 0, 4.5}, {0, -3.4, 0});
      rib.matte({0.75, 0.72, 0.66});
      rib.quad({-3, 2.4, -3.1}, {6, 0, 0}, {0, 0, 4.5});
      rib.matte({0.38, 0.24, 0.14});  // the table
      rib.pillow({0, -0.035, 0.15}, {1.0, 0.03, 0.85}, 0.02);
    });
    rib.attribute([&] {  // a lattice of laths on the wall
      rib.matte({0.35, 0.25, 0.17});
      for (int k = 0; k < 14; ++k) rib.block({-1.5 + 0.22 * k, 0.7, 1.32}, {0.012, 1.4, 0.012});
      for (int k = 0; k < 6; ++k) rib.block({0, 0.05 + 0.26 * k, 1.3}, {2.2, 0.012, 0.012});
    });
  }

  /// Laid over the table in folds, checked.
  void cloth(MaafRib& rib) const {
    rib.attribute([&] {
      rib.checker({0.78, 0.74, 0.64}, {0.5, 0.18, 0.16}, 1);
      constexpr int columns = 40, rows = 28;
      rib.sheet({columns, rows, false, {22, 16}}, [&](int i, int j) {
        const double x = -0.75 + 1.3 * i / (columns - 1), z = -0.78 + 0.95 * j / (rows - 1);
        const double rim = std::max(
            0.0, 1 - 3.5 * std::min({i / 39.0, (39 - i) / 39.0, j / 27.0, (27 - j) / 27.0}));
        const double fold = 0.012 * std::sin(17 * x + 5 * std::sin(4 * z)) +
                            0.01 * std::sin(21 * z - 3 * x) + 0.016;
        const double over_edge = std::max(0.0, -0.7 - z);
        return glm::dvec3(x + 0.015 * std::sin(9 * z), 0.003 + rim * fold - 2 * over_edge,
                          z + 0.012 * std::sin(11 * x));
      });
    });
  }

  void apple(MaafRib& rib, const glm::dvec3& place, double size, const Albedo& color,
             double turn_degrees, double tilt_degrees) const {
    rib.attribute([&] {
      rib.add("Translate {} {} {} Rotate {} 0 1 0 Rotate {} 1 0 0 Scale {s} {s} {s}", place.x,
              place.y, place.z, turn_degrees, tilt_degrees, fmt::arg("s", size));
      rib.matte(color);
      rib.turned({0, -1, 0}, {{0, 0.18},
                              {0.3, 0.05},
                              {0.7, 0.2},
                              {1, 0.75},
                              {1.05, 1.25},
                              {0.8, 1.75},
                              {0.35, 1.85},
                              {0.12, 1.65},
                              {0, 1.6}});
      rib.matte({0.25, 0.16, 0.08});
      rib.tube({{0, 0.55, 0}, {0.02, 0.75, 0}, {0.08, 0.95, 0}, {0.2, 1.15, 0.03}},
               [](double s) { return 0.045 + 0.02 * s; });
    });
  }

  void fruit_bowl(MaafRib& rib) const {
    rib.attribute([&] {
      rib.matte({0.25, 0.38, 0.5});
      rib.turned({0.02, 0.004, 0.08}, {{0, 0},
                                       {0.07, 0},
                                       {0.075, 0.015},
                                       {0.06, 0.025},
                                       {0.1, 0.05},
                                       {0.16, 0.085},
                                       {0.185, 0.125},
                                       {0.183, 0.13},
                                       {0.176, 0.126},
                                       {0.15, 0.09},
                                       {0.09, 0.06},
                                       {0, 0.045}});
    });
    const Albedo red(0.62, 0.1, 0.06), green(0.42, 0.52, 0.12), orange(0.8, 0.36, 0.05);
    apple(rib, {0.1, 0.14, 0.03}, 0.05, red, 20, 25);
    apple(rib, {-0.06, 0.142, 0.02}, 0.048, green, 160, -20);
    apple(rib, {0.07, 0.145, 0.16}, 0.05, red, 260, 15);
    rib.attribute([&] {
      rib.matte(orange);
      rib.ball({-0.055, 0.145, 0.135}, {0.049, 0.048, 0.049});
      rib.ball({0.015, 0.195, 0.085}, {0.05, 0.049, 0.05});
      rib.matte({0.75, 0.62, 0.1});  // bananas
      for (int k = 0; k < 3; ++k) {
        std::vector<glm::dvec3> path;
        glm::dvec3 at(0.27, 0.045, 0.17);
        for (int j = 0; j < 10; ++j) {
          path.push_back(at);
          const double angle = -1.1 - 0.32 * k + 0.13 * j;
          at += 0.02 * glm::dvec3(std::cos(angle), j < 3 ? -0.25 : 0.0, std::sin(angle));
        }
        rib.tube(path, [](double s) { return 0.004 + 0.017 * std::sin(0.2 + 2.75 * s); });
      }
    });
  }

  void bottle(MaafRib& rib, const glm::dvec3& foot, double size, const Albedo& color) const {
    rib.attribute([&] {
      rib.add("Translate {} {} {} Scale {s} {s} {s}", foot.x, foot.y, foot.z, fmt::arg("s", size));
      rib.matte(color);
      rib.turned({0, 0, 0}, {{0, 0.02},
                             {0.025, 0.003},
                             {0.04, 0.002},
                             {0.042, 0.02},
                             {0.042, 0.19},
                             {0.04, 0.22},
                             {0.016, 0.25},
                             {0.0145, 0.32},
                             {0.0145, 0.325}});
      rib.ring({0, 0.315, 0}, 0.015, 0.003);
      rib.matte({0.75, 0.7, 0.58});
      rib.add(
          "TransformBegin Translate 0 0.06 0 Rotate -90 1 0 0 Cylinder 0.0428 0 0.09 360 "
          "TransformEnd");
      rib.matte({0.5, 0.35, 0.2});
      rib.rod({0, 0.32, 0}, {0, 0.345, 0}, 0.011, 0.012);
      rib.disk({0, 0.345, 0}, 0.012);
    });
  }

  void cup(MaafRib& rib, const glm::dvec3& place, double turn_degrees) const {
    rib.placed(place + glm::dvec3(0, 0.006, 0), turn_degrees, [&] {
      rib.matte({0.78, 0.74, 0.66});
      rib.turned({0, 0, 0},
                 {{0, 0}, {0.04, 0}, {0.075, 0.012}, {0.073, 0.016}, {0.04, 0.006}, {0, 0.006}});
      rib.turned({0, 0.006, 0}, {{0, 0},
                                 {0.022, 0},
                                 {0.024, 0.006},
                                 {0.038, 0.03},
                                 {0.043, 0.062},
                                 {0.041, 0.063},
                                 {0.035, 0.03},
                                 {0, 0.01}});
      rib.add("TransformBegin Translate 0.044 0.04 0 Torus 0.016 0.0035 0 360 360 TransformEnd");
      rib.matte({0.16, 0.09, 0.05});
      rib.disk({0, 0.05, 0}, 0.036);
    });
  }

  void pears(MaafRib& rib) const {
    for (int k = 0; k < 2; ++k)
      rib.attribute([&] {
        rib.add("Translate {} {} {}", k ? 0.18 : 0.1, k ? 0.041 : 0.002, k ? -0.32 : -0.24);
        if (k) rib.add("Rotate 60 0 1 0 Rotate 96 1 0 0 Translate 0 -0.05 0");
        rib.matte({0.6, 0.58, 0.16});
        rib.turned({0, 0, 0}, {{0, 0.004},
                               {0.02, 0.001},
                               {0.038, 0.015},
                               {0.044, 0.04},
                               {0.032, 0.07},
                               {0.019, 0.095},
                               {0.012, 0.108},
                               {0, 0.108}});
        rib.matte({0.22, 0.14, 0.07});
        rib.tube({{0, 0.1, 0}, {0.002, 0.115, 0}, {0.006, 0.128, 0}}, [](double) { return 0.002; });
      });
  }

  /// A heap before the bowl.
  void grapes(MaafRib& rib) const {
    rib.attribute([&] {
      rib.matte({0.24, 0.1, 0.26});
      constexpr double r = 0.0125;
      for (int k = 0; k < 46; ++k) {
        const int layer = k < 26 ? 0 : k < 40 ? 1 : 2;
        const double reach = (0.085 - 0.022 * layer) * std::sqrt(MaafRib::pick(k, 21));
        const double angle = 2.4 * k;
        rib.ball({-0.13 + 1.25 * reach * std::cos(angle), 0.014 + 0.02 * layer,
                  -0.22 + 0.7 * reach * std::sin(angle)},
                 {r, 1.12 * r, r});
      }
      rib.matte({0.3, 0.25, 0.12});
      rib.tube({{-0.1, 0.05, -0.22}, {-0.07, 0.06, -0.22}, {-0.03, 0.055, -0.23}, {0, 0.05, -0.26}},
               [](double) { return 0.0022; });
    });
  }

  void candlestick(MaafRib& rib, const glm::dvec3& foot) const {
    rib.attribute([&] {
      rib.matte({0.5, 0.38, 0.16});
      rib.turned(foot, {{0, 0},
                        {0.06, 0},
                        {0.062, 0.01},
                        {0.02, 0.03},
                        {0.012, 0.06},
                        {0.02, 0.08},
                        {0.01, 0.1},
                        {0.01, 0.2},
                        {0.018, 0.22},
                        {0.012, 0.235},
                        {0.035, 0.25},
                        {0.035, 0.256},
                        {0, 0.256}});
      rib.matte({0.8, 0.76, 0.66});
      rib.rod(foot + glm::dvec3(0, 0.25, 0), foot + glm::dvec3(0, 0.43, 0), 0.0105, 0.01);
      rib.disk(foot + glm::dvec3(0, 0.43, 0), 0.01);
      rib.matte({0.1, 0.1, 0.1});
      rib.rod(foot + glm::dvec3(0, 0.43, 0), foot + glm::dvec3(0.002, 0.445, 0), 0.001, 0.001);
    });
  }

  void books(MaafRib& rib) const {
    const Albedo covers[] = {{0.4, 0.12, 0.1}, {0.14, 0.25, 0.22}, {0.5, 0.4, 0.22}};
    for (int k = 0; k < 3; ++k)
      rib.placed({0.66, 0.025 + 0.042 * k, 0.2}, 12 + 17.0 * k, [&] {
        rib.matte(covers[k]);
        for (const double y : {-0.019, 0.019}) rib.block({0, y, 0}, {0.1, 0.0018, 0.14});
        rib.block({-0.1, 0, 0}, {0.002, 0.02, 0.14});
        rib.matte({0.75, 0.7, 0.6});
        rib.block({-0.003, 0, 0}, {0.095, 0.017, 0.134});
      });
  }

  void knife(MaafRib& rib) const {
    rib.placed({0.02, 0.012, -0.42}, 62, [&] {
      rib.matte({0.2, 0.12, 0.08});
      rib.pillow({0, 0, -0.06}, {0.011, 0.008, 0.055}, 0.006);
      rib.matte({0.55, 0.56, 0.58});
      rib.sheet({2, 5}, [](int i, int j) {
        const double s = j / 4.0;
        return glm::dvec3(0.011 - 0.022 * i * (1 - s * s), 0.002, -0.01 + 0.16 * s);
      });
    });
  }

  MaafSceneRequest request_;
};

}  // namespace tessera
