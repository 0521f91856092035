// The front against the definition, tried on every pair.

#include <limits>
#include <random>

#include <catch2/catch.hpp>

#include "trade/pareto.h"

using namespace tessera::trade;

namespace {

bool beaten(const Costs& a, const std::vector<Costs>& all) {
  for (const Costs& b : all)
    if (b.time_s <= a.time_s && b.error <= a.error && (b.time_s < a.time_s || b.error < a.error))
      return true;
  return false;
}

}  // namespace

TEST_CASE("the front is what no other point beats, ties included") {
  std::mt19937 random(7);
  for (int trial = 0; trial < 300; ++trial) {
    // A coarse lattice, so that ties in one cost and in both are common.
    std::vector<Costs> points(1 + random() % 25);
    for (Costs& point : points) point = {double(random() % 6), double(random() % 6)};
    const std::vector<bool> front = pareto_front(points);
    REQUIRE(front.size() == points.size());
    for (size_t i = 0; i < points.size(); ++i) REQUIRE(front[i] == !beaten(points[i], points));
  }
}

TEST_CASE("what is not a number is not on the front, and an infinite error may be") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  const std::vector<Costs> points{{nan, 0}, {0, nan}, {1, infinite}, {2, 1}};
  CHECK(pareto_front(points) == std::vector<bool>{false, false, true, true});
  CHECK(pareto_front({}).empty());
}
