#include "reconstruct/guard.h"

#include <algorithm>

#include <tbb/parallel_for.h>

namespace tessera {
namespace {

/// Pixels whose squares would come near the end of floats say nothing.
constexpr float largest_sum = 1e30f;

/// How far the sum of squared differences may exceed what noise explains before it counts as bias:
/// more than one and a half of its standard deviations over 81 pixels.
constexpr float chance = 1.4f;

struct Sums {
  std::vector<float> gain;        ///< (1 - w) s2
  std::vector<float> difference;  ///< (F - y)^2
};

void sum_pixel(const Component& c, size_t p, Sums& out) {
  float gain = 0, difference = 0;
  for (size_t channel = 0; channel < 3; ++channel) {
    const float d = c.filtered[channel][p] - c.plain[channel][p];
    const float variance = c.variance[channel][p];
    difference += d * d;
    gain += variance < 0 ? d * d : std::max(0.0f, 1 - c.own_weight[p]) * variance;
  }
  const bool sane = difference < largest_sum && gain < largest_sum;
  out.gain[p] = sane ? gain : 0.0f;
  out.difference[p] = sane ? difference : 0.0f;
}

/// Sums over 2 guard_reach + 1 pixels along one axis, each afresh, so that a crop has the sums of
/// the whole frame.
std::vector<float> box_sums(const std::vector<float>& in, int width, int height, bool rows) {
  std::vector<float> out(in.size());
  tbb::parallel_for(0, height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const int at = rows ? x : y, size = rows ? width : height;
      const int first = std::max(0, at - guard_reach), last = std::min(size - 1, at + guard_reach);
      float sum = 0;
      for (int k = first; k <= last; ++k)
        sum += in[size_t(rows ? y : k) * size_t(width) + size_t(rows ? k : x)];
      out[size_t(y) * size_t(width) + size_t(x)] = sum;
    }
  });
  return out;
}

std::vector<float> window_sums(const std::vector<float>& in, int width, int height) {
  return box_sums(box_sums(in, width, height, false), width, height, true);
}

}  // namespace

std::vector<float> filtered_shares(const Component& component,
                                   const std::vector<float>* shared) {
  const size_t pixels = component.pixels();
  Sums sums{std::vector<float>(pixels), std::vector<float>(pixels)};
  tbb::parallel_for(0, component.height, [&](int y) {
    const size_t first = size_t(y) * size_t(component.width);
    for (size_t p = first; p < first + size_t(component.width); ++p)
      if (!shared || (*shared)[p] != 0.0f) sum_pixel(component, p, sums);
  });
  const std::vector<float> gain = window_sums(sums.gain, component.width, component.height);
  const std::vector<float> difference =
      window_sums(sums.difference, component.width, component.height);
  std::vector<float> shares(pixels);
  for (size_t p = 0; p < pixels; ++p) {
    const bool outlier = shared && (*shared)[p] == 0.0f;
    if (!outlier && gain[p] > 0)
      shares[p] = gain[p] / (gain[p] + std::max(0.0f, difference[p] - chance * gain[p]));
  }
  return shares;
}

}  // namespace tessera
