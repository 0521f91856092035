#pragma once
/// A vase of flowers for the still life: stems and petals cast thin shadows.

#include "bench/maaf_rib.h"

namespace tessera {

class Bouquet {
 public:
  /// The vase stands on `foot`.
  static void add(MaafRib& rib, const glm::dvec3& foot) {
    rib.attribute([&] {
      rib.checker({0.62, 0.64, 0.66}, {0.16, 0.28, 0.5}, 1);
      rib.turned(foot,
                 {{0, 0.002},
                  {0.06, 0.002},
                  {0.065, 0.02},
                  {0.095, 0.11},
                  {0.085, 0.19},
                  {0.045, 0.25},
                  {0.04, 0.28},
                  {0.058, 0.31},
                  {0.054, 0.312},
                  {0.034, 0.28},
                  {0.03, 0.22}},
                 {12, 8});
    });
    constexpr int stems = 9;
    for (int k = 0; k < stems; ++k) {
      const double angle = 2 * std::numbers::pi * (k + 0.4 * MaafRib::pick(k, 3)) / stems;
      const double spread = 0.07 + 0.13 * MaafRib::pick(k, 5),
                   tall = 0.37 + 0.12 * MaafRib::pick(k, 9);
      const glm::dvec3 out(std::cos(angle), 0, std::sin(angle));
      const auto at = [&](double s) {
        return foot + glm::dvec3(0, glm::mix(0.13, tall, s), 0) + (0.01 + spread * s * s) * out;
      };
      rib.attribute([&] {
        rib.matte({0.16, 0.32, 0.1});
        std::vector<glm::dvec3> path;
        for (int j = 0; j < 7; ++j) path.push_back(at(j / 6.0));
        rib.tube(path, [](double) { return 0.0035; });
        for (const double s : {0.55, 0.75}) leaf(rib, at(s), out, 0.09, 70 * s + 40.0 * k);
      });
      flower(rib, at(1), out, k);
    }
  }

 private:
  static void leaf(MaafRib& rib, const glm::dvec3& root, const glm::dvec3& out, double size,
                   double turn_degrees) {
    const double a = turn_degrees * std::numbers::pi / 180;
    const glm::dvec3 along(out.x * std::cos(a) - out.z * std::sin(a), 0.5,
                           out.x * std::sin(a) + out.z * std::cos(a));
    const glm::dvec3 aside = glm::normalize(glm::cross(along, glm::dvec3(0, 1, 0)));
    rib.sheet({3, 6}, [&](int i, int j) {
      const double s = j / 5.0, half = 0.24 * std::sin(std::numbers::pi * (0.06 + 0.9 * s));
      return root + size * (s * along + (i - 1) * half * aside +
                            glm::dvec3(0, (i == 1 ? -0.06 : 0.0) - 0.55 * s * s, 0));
    });
  }

  static void flower(MaafRib& rib, const glm::dvec3& center, const glm::dvec3& out, int k) {
    const Albedo colors[] = {{0.75, 0.3, 0.4}, {0.8, 0.7, 0.3}, {0.7, 0.68, 0.72}};
    rib.attribute([&] {
      rib.frame_at(center, glm::normalize(0.6 * out + glm::dvec3(0, 0.6, -0.45)));
      rib.matte({0.55, 0.35, 0.06});
      rib.ball({0, 0, 0.006}, {0.013, 0.013, 0.009});
      rib.matte(colors[k % 3]);
      constexpr int petals = 9;
      for (int p = 0; p < petals; ++p) {
        const double a = 2 * std::numbers::pi * p / petals;
        const glm::dvec3 along(std::cos(a), std::sin(a), 0), aside(-std::sin(a), std::cos(a), 0);
        rib.sheet({3, 4}, [&](int i, int j) {
          const double s = j / 3.0;
          return (0.008 + 0.038 * s) * along +
                 (i - 1) * (0.005 + 0.012 * std::sin(2.6 * s)) * aside +
                 glm::dvec3(0, 0, 0.012 * s * s + (i == 1 ? 0 : 0.004));
        });
      }
    });
  }
};

}  // namespace tessera
