#include "engine/sample_spreads.h"

#include <cmath>

#include <glm/glm.hpp>

namespace tessera {
namespace {

/// sqrt(3) times the root mean square of `distance_of(k)` over k < `count`.
template <class DistanceOf>
float spread(int count, const DistanceOf& distance_of) {
  double squares = 0;
  for (int k = 0; k < count; ++k) {
    const double distance = distance_of(k);
    squares += distance * distance;
  }
  return float(std::sqrt(3 * squares / count));
}

}  // namespace

float lens_spread(const LensProfile& lens) {
  constexpr int side = 64;
  return spread(side * side, [&](int k) {
    const glm::vec2 at =
        lens.sample((float(k % side) + 0.5f) / side, (float(k / side) + 0.5f) / side);
    return std::sqrt(0.5 * double(glm::dot(at, at)));
  });
}

float time_spread(const ShutterProfile& shutter) {
  constexpr int strata = 1024;
  return spread(strata,
                [&](int k) { return double(shutter.sample((float(k) + 0.5f) / strata)) - 0.5; });
}

}  // namespace tessera
