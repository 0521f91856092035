#pragma once
/// Points of a solid pattern with the shading cells around them, and means over long cells.

#include <algorithm>
#include <cmath>

#include "shade/values.h"

namespace tessera {

/// Look-ups along a long cell, at most; as many as anisotropic texture look-ups take.
inline constexpr int most_taps = 16;

/// How many to take along a cell of that length and width: 1 up to half as long again as wide.
inline int taps_along(float length, float width) {
  const float ratio = length / width;  // NaN where both are 0
  if (!(ratio >= 1.5f)) return 1;
  return ratio < float(most_taps) ? int(ratio + 0.5f) : most_taps;
}

/// The principal axes of the parallelogram with edges a and b: full lengths, so that a rectangle
/// with these edges has the covariance of the parallelogram. `major` is the longer. Vec is
/// glm::vec2 or glm::vec3. Edges at right angles come back unchanged.
template <class Vec>
struct CellAxes {
  Vec major, minor;
};
template <class Vec>
CellAxes<Vec> principal_axes(const Vec& a, const Vec& b) {
  const float aa = glm::dot(a, a), bb = glm::dot(b, b), ab = glm::dot(a, b);
  if (ab == 0.0f) return aa < bb ? CellAxes<Vec>{b, a} : CellAxes<Vec>{a, b};
  // One Jacobi rotation makes the matrix of their products diagonal.
  const float tau = (bb - aa) / (2.0f * ab);
  const float t = (tau < 0.0f ? -1.0f : 1.0f) / (std::abs(tau) + std::sqrt(1.0f + tau * tau));
  const float c = 1.0f / std::sqrt(1.0f + t * t), s = t * c;
  const Vec first = c * a - s * b, second = s * a + c * b;
  return glm::dot(first, first) < glm::dot(second, second) ? CellAxes<Vec>{second, first}
                                                           : CellAxes<Vec>{first, second};
}

/// Points in the space a solid pattern lives in.
struct PatternPoints {
  Vec3Array P;                         ///< shader space
  AlignedVector<float> footprint;      ///< length of a shading cell there; 0: do not filter
  Vec3Array along;                     ///< the cell's major axis where it is long, otherwise unused
  AlignedVector<int> taps;             ///< points along it that hold the cell; 1 for a compact cell
  AlignedVector<float> tap_footprint;  ///< length of the part of the cell around each

  /// The mean over cell i of `value(P, footprint)`: of one value for a compact cell, of up to
  /// most_taps along a long one, each filtered over its part.
  template <class Value>
  auto average_over_cell(int i, const Value& value) const {
    const size_t k = size_t(i);
    if (taps[k] == 1) return value(P[i], footprint[k]);
    const float share = 1.0f / float(taps[k]);
    const auto at = [&](int tap) {
      const float offset = (float(tap) + 0.5f) * share - 0.5f;
      return value(P[i] + offset * along[i], tap_footprint[k]);
    };
    auto sum = at(0);
    for (int tap = 1; tap < taps[k]; ++tap) sum += at(tap);
    return sum * share;
  }
};

}  // namespace tessera
