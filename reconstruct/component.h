#pragma once
/// A colour that is filtered by itself: unfiltered, how noisy it is, and filtered in several ways.

#include <array>
#include <cmath>
#include <vector>

#include "reconstruct/stack_filter.h"

namespace tessera {

/// One filtered version of a colour.
struct Candidate {
  Planes filtered;  ///< [channel][pixel]
  /// Share of the filtered value that the pixel's own noise has, of the noise of what is
  /// unfiltered.
  std::vector<float> own_weight;
};

/// Planes [channel][pixel] of a rectangle `width` pixels wide.
struct Component {
  Component(int row_width, int rows)
      : width(row_width), height(rows), plain(3, std::vector<float>(pixels())), deviation(plain) {}

  size_t pixels() const { return size_t(width) * size_t(height); }

  int width, height;
  Planes plain;
  Planes deviation;  ///< the standard deviation of the noise of `plain`; below 0: not known
  std::vector<Candidate> candidates{};
};

/// A quotient of two sums of samples and the standard deviation of its noise, told from two halves
/// of the samples: halves of weights e and 1 - e that come to a and b say sqrt(e (1 - e)) |a - b|,
/// as the variance of a mean is inverse to its weight. (Its square may be no float.)
struct Quotient {
  float value = 0, deviation = 0;  ///< deviation below 0: not known
};
inline constexpr float smallest_divisor = 1e-20f;

inline Quotient halves_quotient(float sum, float even_sum, float divisor, float even_divisor) {
  Quotient q;
  if (!(std::abs(divisor) > smallest_divisor)) return q;
  q.value = sum / divisor;
  const float share = even_divisor / divisor;
  const float odd_divisor = divisor - even_divisor;
  if (!(share > 1e-3f && share < 1.0f - 1e-3f)) {
    q.deviation = -1;
    return q;
  }
  const float difference = even_sum / even_divisor - (sum - even_sum) / odd_divisor;
  q.deviation = std::sqrt(share * (1 - share)) * std::abs(difference);
  if (!std::isfinite(q.deviation)) q.deviation = -1;
  if (!std::isfinite(q.value)) q = {};
  return q;
}

}  // namespace tessera
