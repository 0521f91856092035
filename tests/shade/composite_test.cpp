#include <catch2/catch.hpp>

#include <cmath>

#include "shade/aov.h"
#include "tests/shade/fixtures.h"

using namespace tessera;
using namespace tessera::test;

namespace {

/// Values of one channel group, one sample, for two surfaces: 0 as given, 1 opaque and blue.
struct Stack {
  TestScene test;
  TestBucket bucket{2};
  ShadedFragments shaded;

  explicit Stack(bool matte_in_front) {
    Attributes front;
    front.matte = matte_in_front;
    test.add_surface(front);
    test.add_surface(Attributes{});
    test.bind();
    bucket.grids = {make_square(test.scene.surfaces[0], 1, 2.0f),
                    make_square(test.scene.surfaces[1], 1, 4.0f)};
    bucket.add(0, 0, 0.25f, 0.5f, 2.0f);
    bucket.add(1, 1, 0.25f, 0.5f, 4.0f);
    bucket.finish_sample();
    bucket.finish_sample();  // the second sample sees nothing
  }
  void colors(glm::vec3 Ci, glm::vec3 Oi) {
    const glm::vec3 back(0.0f, 0.0f, 1.0f), opaque(1.0f);
    for (int c = 0; c < 3; ++c) {
      shaded.Ci[size_t(c)] = {Ci[c], back[c]};
      shaded.Oi[size_t(c)] = {Oi[c], opaque[c]};
    }
  }
  /// [channel * 2 + sample]
  std::vector<float> group(const char* name) {
    std::vector<std::vector<float>> out;
    const AovDefinition* definition = &find_aov(name);
    composite(bucket.input(), shaded, *test.camera, {&definition, 1}, out);
    REQUIRE(out.size() == 1);
    return out[0];
  }
};

}  // namespace

TEST_CASE("two layers composite as over, a channel at a time") {
  Stack stack(false);
  stack.colors({0.1f, 0.2f, 0.3f}, {0.5f, 0.25f, 0.75f});
  CHECK(stack.group("rgb") == std::vector<float>{0.1f, 0, 0.2f, 0, 0.3f + 0.25f * 1.0f, 0});
  CHECK(stack.group("Ci") == stack.group("rgb"));
  CHECK(stack.group("Oi") == std::vector<float>{1, 0, 1, 0, 1, 0});
  CHECK(stack.group("a") == std::vector<float>{1, 0});
}

TEST_CASE("a failed fragment spoils the sample that sees it, and only that") {
  Stack stack(false);
  const auto fail_behind = [&](glm::vec3 opacity) {
    stack.colors({0.1f, 0.2f, 0.3f}, opacity);
    for (std::vector<float>& c : stack.shaded.Ci) c[1] = std::nanf("");
    return stack.group("rgb");
  };
  CHECK(fail_behind({1, 1, 1}) == std::vector<float>{0.1f, 0, 0.2f, 0, 0.3f, 0});
  CHECK(std::isnan(fail_behind({1, 0.5f, 1})[2]));
  CHECK(std::isnan(fail_behind({0, 0, 0})[0]));
}

TEST_CASE("alpha is the mean opacity met") {
  Stack stack(false);
  stack.colors({0, 0, 0}, {0.5f, 0.25f, 0.75f});
  stack.shaded.Oi[0][1] = stack.shaded.Oi[1][1] = stack.shaded.Oi[2][1] = 0.5f;
  const double expected = ((0.5 + 0.5 * 0.5) + (0.25 + 0.75 * 0.5) + (0.75 + 0.25 * 0.5)) / 3.0;
  CHECK(stack.group("a")[0] == Approx(expected));
}

TEST_CASE("a matte surface holds out what is behind it and adds nothing") {
  Stack stack(true);
  stack.colors({0.9f, 0.9f, 0.9f}, {1.0f, 0.5f, 0.25f});
  CHECK(stack.group("rgb") == std::vector<float>{0, 0, 0, 0, 0.75f, 0});
  CHECK(stack.group("Oi") == std::vector<float>{0, 0, 0.5f, 0, 0.75f, 0});
  CHECK(stack.group("z")[0] == 1e38f);
  CHECK(stack.group("id")[0] == 0.0f);
}

TEST_CASE("closest groups show the first surface that is not wholly transparent") {
  Stack stack(false);
  stack.colors({0, 0, 0}, {0.0f, 0.01f, 0.0f});
  CHECK(stack.group("z") == std::vector<float>{2.0f, 1e38f});
  CHECK(stack.group("id") == std::vector<float>{1.0f, 0.0f});
  stack.colors({0, 0, 0}, {0, 0, 0});
  CHECK(stack.group("z")[0] == 4.0f);
  CHECK(stack.group("id")[0] == 2.0f);
  CHECK(stack.group("N") == std::vector<float>{0, 0, 0, 0, -1, 0});
  // Triangle (a, d, c) of the unit square of st with weights 1/4, 1/4, 1/2.
  CHECK(stack.group("st") == std::vector<float>{0.25f, 0, 0.75f, 0});
  CHECK(stack.group("P") == std::vector<float>{-0.5f, 0, 0.5f, 0, 4.0f, 0});
  CHECK(stack.group("motion") == std::vector<float>{0, 0, 0, 0});
}

TEST_CASE("position follows the sample's time and motion is the shift on screen") {
  TestScene test;
  const Surface& surface = test.add_surface(Attributes{});
  test.bind();
  const auto grid = make_square(surface, 1, 2.0f);
  add_key(*grid, 0.25f, [](const glm::vec3& P) { return P + glm::vec3(1, 0, 0); });
  add_key(*grid, 1.0f, [](const glm::vec3& P) { return P + glm::vec3(-2, 0, 2); });
  TestBucket bucket(3);
  bucket.samples.t = {0.0f, 0.125f, 0.625f};
  bucket.grids = {grid};
  for (const float z : {2.0f, 2.0f, 3.0f}) {
    bucket.add(0, 0, 0.25f, 0.5f, z);  // rest position (0.5, 0, 2)
    bucket.finish_sample();
  }
  ShadedFragments shaded;
  for (size_t c = 0; c < 3; ++c) {
    shaded.Ci[c].assign(3, 1.0f);
    shaded.Oi[c].assign(3, 1.0f);
  }
  const std::vector<const AovDefinition*> groups{&find_aov("P"), &find_aov("motion")};
  std::vector<std::vector<float>> out;
  composite(bucket.input(), shaded, *test.camera, groups, out);
  CHECK(out[0][0] == 0.5f);
  CHECK(out[0][1] == 1.0f);
  CHECK(out[0][2] == 0.0f);  // half way between 1.5 and -1.5
  CHECK(out[0][2 * 3 + 2] == 3.0f);
  // 100 pixels over 2 units at depth 1: x / z goes from 0.25 to -1.5 / 4.
  for (size_t s = 0; s < 3; ++s) CHECK(out[1][s] == Approx((-0.375 - 0.25) * 50.0));
  CHECK(out[1][3] == Approx(0.0).margin(1e-5));
  for (size_t k = 0; k < grid->stride(); ++k) grid->P(2, 2)[k] = -1.0f;
  composite(bucket.input(), shaded, *test.camera, groups, out);
  CHECK(out[1][0] == 0.0f);  // ends behind the eye
}
