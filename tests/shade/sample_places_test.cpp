// Places that samples have of their own on the lights of an effect.

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

#include "hide/samples.h"
#include "shade/sample_places.h"

using namespace tessera;

TEST_CASE("further lights of an effect have nets of their own that tell nothing of the first") {
  SampleBlock block;
  SamplePattern(16, 5, nullptr, nullptr, {}, {true, true}).fill({3, 2, 35, 34}, block);
  const SamplePlaces first(block, RayEffect::shadow, 0), second(block, RayEffect::shadow, 1),
      third(block, RayEffect::shadow, 2), other(block, RayEffect::bounce, 1);
  double ab = 0, bc = 0, bd = 0, pixels_ab = 0, order = 0;
  const double n = double(block.size());
  for (uint32_t s = 0; s < block.size(); s += 16) {
    double pixel_a = 0, pixel_b = 0, within = 0;
    for (const SamplePlaces* places : {&second, &third}) {
      bool hit[4][4] = {}, row[16] = {}, column[16] = {};
      for (uint32_t k = s; k < s + 16; ++k) {
        const glm::vec2 at = places->of_sample(k);
        REQUIRE((at.x >= 0 && at.x < 1 && at.y >= 0 && at.y < 1));
        hit[int(at.x * 4)][int(at.y * 4)] = true;
        row[int(at.y * 16)] = true, column[int(at.x * 16)] = true;
      }
      REQUIRE(std::count(&hit[0][0], &hit[0][0] + 16, true) == 16);
      REQUIRE(std::count(row, row + 16, true) == 16);
      REQUIRE(std::count(column, column + 16, true) == 16);
    }
    for (uint32_t k = s; k < s + 16; ++k) {
      const glm::dvec2 a(first.of_sample(k)), b(second.of_sample(k)), c(third.of_sample(k));
      const glm::dvec2 d(other.of_sample(k));
      REQUIRE(a == glm::dvec2(block.light_x[k], block.light_y[k]));
      ab += (a.x - 0.5) * (b.x - 0.5) * 12 / n, bc += (b.x - 0.5) * (c.x - 0.5) * 12 / n;
      bd += (b.y - 0.5) * (d.y - 0.5) * 12 / n;
      pixel_a += a.x - 0.5, pixel_b += b.x - 0.5;
      within += (a.x - 0.5) * (b.x - 0.5) * 12 / 16;
    }
    // The error of a pixel's 16: each is uniform within 1/16, so the sum has variance 16/12/256.
    pixels_ab += pixel_a * pixel_b / (16.0 / 12 / 256) / (n / 16);
    order += within * within / (n / 16);
  }
  // 1 / sqrt(16384) = 0.008 a deviation, 1 / sqrt(1024) = 0.031 for pixels; five of them.
  CHECK(std::abs(ab) < 0.04);
  CHECK(std::abs(bc) < 0.04);
  CHECK(std::abs(bd) < 0.04);
  CHECK(std::abs(pixels_ab) < 0.16);
  // Sixteen pairs in any order: 1/15. In one order, whose first digits agree or all differ: half.
  CHECK(order < 0.15);
}
