#pragma once
/// Three toasters on a kitchen table under one round lamp: bodies with slots of subdivision
/// surfaces, levers, bread, plates; the one in the middle is in focus.

#include "bench/maaf_rib.h"

namespace tessera {

class Toasters {
 public:
  explicit Toasters(const MaafSceneRequest& request) : request_(request) {}

  std::string text() const {
    MaafRib rib(request_);
    rib.view({{-0.2, 0.62, -1.25}, {0.03, 0.09, 0.15}}, 32, 0.02, 1.4);
    rib.add("WorldBegin");
    rib.shining_sphere(1, {0.75, 1.25, -0.25}, 0.16, 50, {1, 0.95, 0.88});
    rib.bounce(2, 0.3);
    room(rib);
    toaster(rib, {-0.3, 0, 0.02}, 24, {0.6, 0.14, 0.1}, 1);
    toaster(rib, {0.12, 0, 0.28}, -18, {0.2, 0.42, 0.5}, 2);
    toaster(rib, {0.42, 0, -0.22}, -42, {0.72, 0.62, 0.35}, 0);
    plate(rib, {-0.02, 0, -0.24}, 2);
    plate(rib, {-0.6, 0, 0.45}, 1);
    rack(rib, {-0.33, 0, 0.55});
    jar(rib, {0.5, 0, 0.42}, {0.5, 0.12, 0.1});
    jar(rib, {0.64, 0, 0.3}, {0.6, 0.4, 0.1});
    crumbs(rib);
    knife(rib, {0.14, 0.008, -0.36}, 70);
    rib.add("WorldEnd");
    return rib.text();
  }

 private:
  void room(MaafRib& rib) const {
    rib.attribute([&] {
      rib.checker({0.7, 0.68, 0.62}, {0.4, 0.46, 0.46}, 1);
      rib.quad({-1.4, 0, -1.2}, {2.8, 0, 0}, {0, 0, 2.2}, {22, 17});
      rib.checker({0.72, 0.7, 0.64}, {0.64, 0.62, 0.57}, 1);
      rib.quad({-2.5, 2.2, 1.0}, {5, 0, 0}, {0, -3, 0}, {25, 15});
      rib.matte({0.7, 0.66, 0.56});
      rib.quad({-2.5, 2.2, -2.5}, {0, 0, 3.5}, {0, -3, 0});
      rib.matte({0.5, 0.6, 0.55});
      rib.quad({2.5, 2.2, -2.5}, {0, 0, 3.5}, {0, -3, 0});
      rib.matte({0.75, 0.74, 0.7});
      rib.quad({-2.5, 2.2, -2.5}, {5, 0, 0}, {0, 0, 3.5});
      rib.matte({0.35, 0.22, 0.13});  // a shelf with hooks and ladles
      rib.pillow({0, 0.72, 0.9}, {0.9, 0.015, 0.1}, 0.008);
    });
    for (int k = 0; k < 7; ++k)
      rib.attribute([&] {
        const double x = -0.75 + 0.24 * k;
        rib.matte({0.3, 0.31, 0.33});
        rib.rod({x, 0.71, 0.88}, {x, 0.42, 0.87}, 0.005, 0.004);
        rib.turned({x, 0.37, 0.87},
                   {{0, 0}, {0.03, 0.005}, {0.045, 0.03}, {0.042, 0.032}, {0, 0.01}});
      });
  }

  /// Half sizes of a body: x along the slots.
  static constexpr double half_x = 0.14, half_z = 0.085, tall = 0.19;

  void toaster(MaafRib& rib, const glm::dvec3& place, double turn_degrees, const Albedo& color,
               int slices) const {
    rib.placed(place, turn_degrees, [&] {
      rib.matte(color);
      rib.smooth_cage(body());
      rib.matte({0.13, 0.13, 0.14});
      for (const double x : {-0.1, 0.1})
        for (const double z : {-0.055, 0.055}) rib.ball({x, 0.01, z}, {0.016, 0.011, 0.016});
      rib.pillow({0, 0.03, 0}, {half_x - 0.012, 0.012, half_z - 0.01}, 0.008);
      lever(rib, slices);
      for (int k = 0; k < slices; ++k) bread(rib, {0, tall + 0.01, k ? 0.032 : -0.032});
      cord(rib);
    });
  }

  /// A rounded box, wider at its foot, two slots from the top almost down to it.
  static MaafRib::Cage body() {
    MaafRib::Cage cage;
    // Thin cells around the slots keep their edges sharp.
    cage.x = {-half_x, -half_x + 0.02, -0.084, -0.08, 0.08, 0.084, half_x - 0.02, half_x};
    cage.y = {0.025, 0.04, 0.06, 0.16, 0.186, tall};
    cage.z = {-half_z, -half_z + 0.02, -0.051, -0.048, -0.016,        -0.013,
              0.013,   0.016,          0.048,  0.051,  half_z - 0.02, half_z};
    cage.solid = [](int i, int j, int k) {
      const bool in_slot = i == 3 && (k == 3 || k == 7) && j >= 2;
      return !in_slot;
    };
    cage.bend = [](const glm::dvec3& p) {
      const double narrow = 1 + 0.1 * (1 - p.y / tall);
      const double belly = 1 - 0.9 * std::pow(p.x / half_x, 2) * 0.12;
      return glm::dvec3(p.x * narrow, p.y, p.z * narrow * belly);
    };
    return cage;
  }

  void lever(MaafRib& rib, int slices) const {
    const double y = slices ? 0.075 : 0.14;
    rib.matte({0.12, 0.12, 0.13});
    rib.block({half_x + 0.005, 0.11, 0}, {0.004, 0.05, 0.006});
    rib.rod({half_x, y, 0}, {half_x + 0.03, y, 0}, 0.004, 0.004);
    rib.pillow({half_x + 0.035, y, 0}, {0.014, 0.008, 0.022}, 0.006);
    rib.add("TransformBegin Translate {} 0.055 0.045 Rotate 90 0 1 0", half_x + 0.005);
    rib.add("Cylinder 0.014 0 0.014 360 Disk 0.014 0.014 360 TransformEnd");
    for (int k = 0; k < 4; ++k)  // ribs along the side
      rib.pillow({0, 0.075 + 0.022 * k, -half_z - 0.002}, {0.09, 0.004, 0.004}, 0.003);
  }

  /// A slice that stands in the plane z = place.z, its middle at `place`.
  void bread(MaafRib& rib, const glm::dvec3& place, double brown = 1) const {
    MaafRib::Cage cage;
    cage.x = {-0.06, -0.045, -0.02, 0.02, 0.045, 0.06};
    cage.y = {-0.06, -0.045, 0, 0.03, 0.05, 0.065};
    cage.z = {-0.009, -0.004, 0.004, 0.009};
    cage.bend = [](const glm::dvec3& p) {
      const double bulge = p.y > 0.02 ? 1.12 - 9 * std::max(0.0, p.y - 0.04) : 1.0;
      return glm::dvec3(p.x * bulge, p.y - 1.6 * p.x * p.x, p.z);
    };
    rib.matte(glm::mix(Albedo(0.75, 0.6, 0.38), Albedo(0.55, 0.34, 0.15), brown));
    rib.smooth_cage(cage, place);
  }

  void cord(MaafRib& rib) const {
    std::vector<glm::dvec3> path;
    for (int k = 0; k < 14; ++k)
      path.emplace_back(-half_x - 0.01 - 0.025 * k, std::max(0.004, 0.045 - 0.02 * k),
                        0.05 * std::sin(0.55 * k));
    rib.matte({0.1, 0.1, 0.11});
    rib.tube(path, [](double) { return 0.0045; });
  }

  void plate(MaafRib& rib, const glm::dvec3& place, int slices) const {
    rib.attribute([&] {
      rib.matte({0.78, 0.77, 0.74});
      rib.turned(place, {{0, 0.002},
                         {0.06, 0.002},
                         {0.065, 0.006},
                         {0.105, 0.018},
                         {0.104, 0.022},
                         {0.063, 0.01},
                         {0, 0.008}});
    });
    for (int k = 0; k < slices; ++k)
      rib.attribute([&] {
        rib.add("Translate {} {} {} Rotate {} 0 1 0 Rotate {} 1 0 0", place.x + 0.02 * k,
                place.y + 0.022 + 0.02 * k, place.z, 35 + 70.0 * k, 90 + 8.0 * k);
        bread(rib, {0, 0, 0}, 0.5 * k);
      });
  }

  /// A toast rack of thin wire.
  void rack(MaafRib& rib, const glm::dvec3& place) const {
    rib.placed(place, 30, [&] {
      rib.matte({0.45, 0.46, 0.48});
      for (int k = 0; k < 6; ++k) {
        std::vector<glm::dvec3> path;
        for (int j = 0; j < 11; ++j) {
          const double a = std::numbers::pi * j / 10;
          path.emplace_back(0.05 * std::cos(a), 0.02 + 0.11 * std::sin(a), 0.035 * (k - 2.5));
        }
        rib.tube(path, [](double) { return 0.003; });
      }
      for (const double x : {-0.05, 0.05}) rib.rod({x, 0.02, -0.1}, {x, 0.02, 0.1}, 0.0035, 0.0035);
      for (int k = 0; k < 3; ++k) bread(rib, {0, 0.085, 0.035 * (k * 2 - 2)}, 0.4);
    });
  }

  void jar(MaafRib& rib, const glm::dvec3& foot, const Albedo& color) const {
    rib.attribute([&] {
      rib.matte(color);
      rib.turned(
          foot,
          {{0, 0.002}, {0.045, 0.002}, {0.05, 0.01}, {0.05, 0.08}, {0.042, 0.1}, {0.042, 0.105}});
      rib.checker({0.75, 0.2, 0.16}, {0.78, 0.75, 0.68}, 1);
      rib.add("TransformBegin Translate {} {} {} Rotate -90 1 0 0", foot.x, foot.y + 0.1, foot.z);
      rib.add("TextureCoordinates [0 0 24 0 0 2 24 2]");
      rib.add("Cylinder 0.046 0 0.022 360 Disk 0.022 0.046 360 TransformEnd");
    });
  }

  void crumbs(MaafRib& rib) const {
    rib.attribute([&] {
      rib.matte({0.55, 0.36, 0.17});
      for (int k = 0; k < 40; ++k) {
        const double r = 0.002 + 0.003 * MaafRib::pick(k, 2);
        rib.ball({-0.25 + 0.5 * MaafRib::pick(k, 5), 0.7 * r, -0.42 + 0.3 * MaafRib::pick(k, 8)},
                 {r, 0.8 * r, 1.3 * r});
      }
    });
  }

  void knife(MaafRib& rib, const glm::dvec3& place, double turn_degrees) const {
    rib.placed(place, turn_degrees, [&] {
      rib.matte({0.16, 0.1, 0.07});
      rib.pillow({0, 0, -0.06}, {0.009, 0.006, 0.05}, 0.004);
      rib.matte({0.55, 0.56, 0.58});
      rib.pillow({0, 0, 0.05}, {0.009, 0.0012, 0.06}, 0.0008);
    });
  }

  MaafSceneRequest request_;
};

}  // namespace tessera
