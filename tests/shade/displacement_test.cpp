#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

#include "tests/shade/fixtures.h"

using namespace tessera;
using namespace tessera::test;

namespace {

std::vector<float> displaced(std::shared_ptr<const ShaderBindings> bindings, const Grid& grid) {
  const auto displacer = make_displacer(std::move(bindings));
  REQUIRE(displacer);
  std::vector<float> distance(grid.stride(), 99.0f);
  displacer->displace(grid, distance);
  return distance;
}

Attributes with_displacement(const ShaderCall& shader) {
  Attributes attributes;
  attributes.displacement = shader;
  return attributes;
}

}  // namespace

TEST_CASE("ripple is its sine in shader space") {
  glm::dmat4 world_from_shader(1.0);
  world_from_shader[0] = {2, 0, 0, 0};  // shader x = world x / 2
  TestScene test;
  const auto grid = make_square(
      test.add_surface(with_displacement(call(
          "ripple", {number("amplitude", 0.3f), number("frequency", 1.5f), number("phase", 0.1f)},
          world_from_shader))),
      16, 5.0f);
  const auto distance = displaced(test.bind(), *grid);
  for (int i = 0; i < grid->vertex_count(); ++i) {
    const double x = double(grid->P(0, 0)[i]) / 2.0;
    CHECK(distance[size_t(i)] == Approx(0.3 * std::sin(2.0 * M_PI * (1.5 * x + 0.1))).margin(1e-6));
  }
}

TEST_CASE("distances are in camera units even when the camera scales the world") {
  TestScene test;
  test.scene.camera.camera_from_world =
      MovingTransform(glm::dmat4({3, 0, 0, 0}, {0, 3, 0, 0}, {0, 0, -3, 0}, {0, 0, 0, 1}));
  const auto grid = make_square(test.add_surface(with_displacement(call(
                                    "ripple", {number("amplitude", 0.5f), number("frequency", 0.0f),
                                               number("phase", 0.25f)}))),
                                2, 5.0f);
  CHECK(displaced(test.bind(), *grid)[4] == Approx(1.5));
}

TEST_CASE("a vertex that two grids share moves alike, however they are diced") {
  for (const char* shader : {"bumpy", "dented", "ripple"}) {
    TestScene test;
    Surface surface = test.add_surface(with_displacement(call(shader)));
    const auto coarse = make_square(surface, 4, 5.0f), fine = make_square(surface, 8, 5.0f, 1);
    const auto bindings = test.bind();
    const auto a = displaced(bindings, *coarse), b = displaced(bindings, *fine);
    INFO(shader);
    bool moved = false;
    for (int j = 0; j <= 4; ++j) {
      for (int i = 0; i <= 4; ++i) {
        const float d = a[size_t(j * 5 + i)];
        CHECK(d == b[size_t(2 * j * 9 + 2 * i)]);
        moved |= d != 0.0f;
      }
    }
    CHECK(moved);
  }
}

TEST_CASE("dents go inwards and no deeper than Km") {
  TestScene test;
  const auto grid =
      make_grid(test.add_surface(with_displacement(call("dented", {number("Km", 2.0f)}))), 64, 64,
                [](float u, float v) { return glm::vec3(40.0f * u, 40.0f * v, 3.3f); });
  const auto distance = displaced(test.bind(), *grid);
  const auto [deepest, highest] =
      std::minmax_element(distance.begin(), distance.begin() + grid->vertex_count());
  CHECK(*deepest > -2.0f);
  CHECK(*deepest < -0.1f);
  CHECK(*highest <= 0.0f);
}

TEST_CASE("Pref, in object space, takes the place of P") {
  TestScene test;
  Surface& surface = test.add_surface(
      with_displacement(call("ripple", {number("amplitude", 1.0f), number("frequency", 1.0f)})));
  glm::dmat4 world_from_object(1.0);
  world_from_object[3] = {0.25, 0, 0, 1};
  surface.world_from_object = MovingTransform(world_from_object);
  const auto grid = make_square(surface, 2, 5.0f);
  const auto Pref = add_primvar(*grid, "Pref", ValueType::point, [](float, float) {
    return std::vector<float>{0, 0, 0};
  });
  CHECK(displaced(test.bind(), *grid)[3] == Approx(1.0));  // sin(2 pi / 4)
}

TEST_CASE("lumps have any number of octaves up to 16, whatever is asked for") {
  const auto lumps = [](float octaves) {
    TestScene test;
    const auto grid =
        make_square(test.add_surface(with_displacement(
                        call("bumpy", {number("octaves", octaves), number("frequency", 3.3f)}))),
                    8, 5.0f);
    return displaced(test.bind(), *grid);
  };
  for (const float many : {17.0f, 1e10f, 1e38f, INFINITY}) CHECK(lumps(many) == lumps(16.0f));
  for (const float none : {-1e10f, -INFINITY, std::nanf("")}) CHECK(lumps(none) == lumps(0.0f));
  CHECK(lumps(16.0f) != lumps(15.0f));
  CHECK(lumps(1.0f) != lumps(0.0f));
}

TEST_CASE("a displacement that is not finite leaves the point where it is") {
  TestScene test;
  const auto grid = make_square(
      test.add_surface(with_displacement(call("ripple", {number("amplitude", std::nanf(""))}))), 2,
      5.0f);
  CHECK(displaced(test.bind(), *grid)[0] == 0.0f);
  CHECK(test.warned("\"ripple\" gave distances that are not finite"));
}

TEST_CASE("surfaces without displacement get zero distances") {
  TestScene test;
  test.add_surface(with_displacement(call("ripple")));
  const Surface& plain = test.add_surface(Attributes{});
  const auto grid = make_square(plain, 2, 5.0f);
  CHECK(displaced(test.bind(), *grid) == std::vector<float>(grid->stride(), 0.0f));
}
