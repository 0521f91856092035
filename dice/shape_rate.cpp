#include "dice/shape_rate.h"

#include <algorithm>
#include <cmath>

namespace tessera {

namespace {

/// Coordinates are off by this part of the largest one after they were rounded and transformed.
constexpr double rounding = 2.5e-7;

/// How far off any of the points may be.
double rounding_of(std::span<const glm::vec3> row) {
  float largest = 0;
  for (const glm::vec3& p : row) {
    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  }
  return rounding * double(largest);
}

/// Between two vectors; zero for what is no more than `least`, what rounding may turn them by. So
/// for vectors that rounding alone may have made, and for what is not a number.
double turn_between(const glm::dvec3& a, const glm::dvec3& b, double least) {
  const double angle = std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
  return angle > least ? angle : 0;
}

double sine_between(const glm::dvec3& a, const glm::dvec3& b) {
  return glm::length(glm::cross(a, b)) / (glm::length(a) * glm::length(b));
}

}  // namespace

void ShapeTurn::add(double sum, double longest, int pieces) {
  turn_radians_ = std::max(turn_radians_, std::min(pieces * longest, 2 * sum));
}

void ShapeTurn::add_row(std::span<const glm::vec3> row) {
  const double off = rounding_of(row);
  double sum = 0, longest = 0;
  for (size_t i = 2; i < row.size(); ++i) {
    const glm::dvec3 before = glm::dvec3(row[i - 1]) - glm::dvec3(row[i - 2]);
    const glm::dvec3 after = glm::dvec3(row[i]) - glm::dvec3(row[i - 1]);
    const double least = 2 * off * (1 / glm::length(before) + 1 / glm::length(after));
    const double turn = turn_between(before, after, least);
    sum += turn, longest = std::max(longest, turn);
  }
  // n pieces show n - 1 turns, half a turn is missing at either end: n times the longest has them.
  add(sum, longest, int(row.size()) - 1);
}

void ShapeTurn::add_strip(std::span<const glm::vec3> row, std::span<const glm::vec3> beside) {
  const double off = std::max(rounding_of(row), rounding_of(beside));
  double sum = 0, longest = 0;
  for (size_t i = 1; i < row.size(); ++i) {
    const glm::dvec3 along = glm::dvec3(row[i]) - glm::dvec3(row[i - 1]);
    const glm::dvec3 from = glm::dvec3(beside[i - 1]) - glm::dvec3(row[i - 1]);
    const glm::dvec3 to = glm::dvec3(beside[i]) - glm::dvec3(row[i]);
    const double least = 2 * off *
                         (1 / glm::length(along) + 1 / glm::length(from) + 1 / glm::length(to)) /
                         std::min(sine_between(along, from), sine_between(along, to));
    const double turn = turn_between(glm::cross(along, from), glm::cross(along, to), least);
    sum += turn, longest = std::max(longest, turn);
  }
  add(sum, longest, int(row.size()) - 1);
}

RowSegments ShapeTurn::segments(const ShapeRate& rate) const {
  const double asked = std::min(std::ceil(turn_radians_ / double(rate.turn_radians)), 1e6);
  const int count = std::max({int(asked), rate.least_segments, 1});
  return {count, count};
}

}  // namespace tessera
