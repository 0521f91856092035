#include <catch2/catch.hpp>

#include <glm/gtc/matrix_transform.hpp>

#include "base/error.h"
#include "base/transform.h"

using namespace tessera;

namespace {

glm::dmat4 shift(double x) { return glm::translate(glm::dmat4(1.0), {x, 0.0, 0.0}); }
double x_at(const MovingTransform& m, float t) { return m.at(t)[3].x; }

}  // namespace

TEST_CASE("a moving transform is linear between keys and held outside them") {
  const MovingTransform m({0.25f, 0.5f, 1.0f}, {shift(0), shift(8), shift(4)});
  CHECK(m.moves());
  CHECK(x_at(m, 0.0f) == 0.0);
  CHECK(x_at(m, 0.25f) == 0.0);
  CHECK(x_at(m, 0.375f) == 4.0);
  CHECK(x_at(m, 0.5f) == 8.0);
  CHECK(x_at(m, 0.75f) == 6.0);
  CHECK(x_at(m, 1.0f) == 4.0);
}

TEST_CASE("keys that do not differ are no motion") {
  const MovingTransform m({0.0f, 1.0f}, {shift(3), shift(3)});
  CHECK_FALSE(m.moves());
  CHECK(m.times().size() == 1);
  CHECK(x_at(m, 0.7f) == 3.0);
  CHECK_FALSE(MovingTransform().moves());
}

TEST_CASE("moving transforms that make no sense are refused") {
  CHECK_THROWS_AS(MovingTransform({}, {}), Error);
  CHECK_THROWS_AS(MovingTransform({0.0f, 1.0f}, {shift(0)}), Error);
  CHECK_THROWS_AS(MovingTransform({1.0f, 0.0f}, {shift(0), shift(1)}), Error);
}

TEST_CASE("a product is exact at the union of the keys") {
  const glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), 1.0, {0.0, 0.0, 1.0});
  const MovingTransform a({0.0f, 0.5f, 1.0f}, {turn, shift(1), shift(5) * turn});
  const MovingTransform b({0.0f, 0.25f, 1.0f}, {shift(2), turn, shift(-1)});
  const MovingTransform product = MovingTransform::product(a, b);
  CHECK(product.times() == std::vector<float>{0.0f, 0.25f, 0.5f, 1.0f});
  for (float t : product.times()) CHECK(product.at(t) == a.at(t) * b.at(t));

  const MovingTransform still =
      MovingTransform::product(MovingTransform(turn), MovingTransform(shift(2)));
  CHECK_FALSE(still.moves());
  CHECK(still.at(0.3f) == turn * shift(2));  // the right-hand factor acts first
}

TEST_CASE("merged key times ascend, without repeats, from 0 to 1") {
  CHECK(merged_key_times({0.0f}, {0.5f}) == std::vector<float>{0.0f});
  CHECK(merged_key_times({0.0f}, {0.2f, 0.8f}) == std::vector<float>{0.0f, 0.2f, 0.8f, 1.0f});
  CHECK(merged_key_times({0.0f, 0.5f, 1.0f}, {-1.0f, 0.5f, 2.0f}) ==
        std::vector<float>{0.0f, 0.5f, 1.0f});
}
