/// Scene time and shutter time, stretch of a matrix, search paths.

#include <random>

#include <catch2/catch.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "scenes/scene_time.h"
#include "scenes/search_path.h"

using namespace tessera;

TEST_CASE("shutter keys reproduce the function of scene time they cut") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-2.0, 3.0);
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<double> times, values;
    for (int i = 0; i < 1 + trial % 5; ++i) times.push_back(number(random));
    std::sort(times.begin(), times.end());
    for (size_t i = 0; i < times.size(); ++i) values.push_back(number(random));
    double open = number(random), close = number(random);
    if (open > close) std::swap(open, close);
    const auto keys = shutter_keys(times, {open, close});
    const auto held = [&](double time) {  // the definition, written out
      if (time <= times.front()) return values.front();
      for (size_t i = 1; i < times.size(); ++i)
        if (time <= times[i])
          return values[i - 1] +
                 (values[i] - values[i - 1]) * (time - times[i - 1]) / (times[i] - times[i - 1]);
      return values.back();
    };
    REQUIRE(keys.front().t == 0.0f);
    if (times.size() > 1) CHECK(keys.back().t == 1.0f);
    for (size_t i = 0; i < keys.size(); ++i) {
      if (i > 0) CHECK(keys[i - 1].t < keys[i].t);
      const double value =
          (1 - keys[i].weight) * values[keys[i].before] + keys[i].weight * values[keys[i].after];
      // Interior key times are rounded to float; the values are those of the exact key.
      const double time = keys[i].weight == 0.0 && i > 0 && i + 1 < keys.size()
                              ? times[keys[i].before]
                              : open + double(keys[i].t) * (close - open);
      CHECK(value == Approx(held(time)).margin(1e-9));
    }
  }
}

TEST_CASE("keys too close for float do not make segments of no length") {
  const auto keys = shutter_keys({0.5, 0.5 + 1e-12, 0.5 + 2e-12}, {0.0, 1.0});
  for (size_t i = 1; i < keys.size(); ++i) CHECK(keys[i - 1].t < keys[i].t);
}

TEST_CASE("products and inverses of keyed transforms") {
  const KeyedTransform a({0, 1}, {glm::dmat4(1.0), glm::translate(glm::dmat4(1.0), {2, 0, 0})});
  const KeyedTransform b({0.5, 2}, {glm::dmat4(1.0), glm::scale(glm::dmat4(1.0), {3, 3, 3})});
  const KeyedTransform ab = a * b;
  CHECK(ab.times() == std::vector<double>{0, 0.5, 1, 2});
  for (double time : ab.times()) CHECK(ab.at(time) == a.at(time) * b.at(time));
  const KeyedTransform unit = a.inverse() * a;
  CHECK(unit == KeyedTransform());
  CHECK(KeyedTransform(glm::scale(glm::dmat4(1.0), {1, -1, 1})).handedness() == -1);
}

TEST_CASE("the largest stretch against brute force over directions") {
  std::mt19937 random(11);
  std::normal_distribution<double> number;
  for (int trial = 0; trial < 50; ++trial) {
    glm::dmat4 matrix(1.0);
    for (int i = 0; i < 9; ++i) matrix[i / 3][i % 3] = number(random) * std::exp(number(random));
    double found = 0.0;
    glm::dvec3 v(number(random), number(random), number(random));
    const glm::dmat3 m(matrix);
    for (int i = 0; i < 2000; ++i) {  // power iteration
      v = glm::normalize(glm::transpose(m) * (m * v));
      found = std::max(found, glm::length(m * v));
    }
    CHECK(largest_stretch(matrix) == Approx(found).epsilon(1e-6));
  }
  CHECK(largest_stretch(glm::dmat4(2.0)) == Approx(2.0));
  CHECK(largest_stretch(glm::dmat4(0.0)) == 0.0);
}

TEST_CASE("search paths") {
  const std::vector<std::string> before{"x", "y"};
  CHECK(parse_search_path("a:&:b", before) == std::vector<std::string>{"a", "x", "y", "b"});
  CHECK(parse_search_path("@::a:", before) == std::vector<std::string>{"a"});
  CHECK(parse_search_path("", before).empty());
}
