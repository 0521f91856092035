#include "reconstruct/outliers.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

namespace tessera {
namespace {

constexpr float far_beyond = 1000.0f;
constexpr float one_half_only = 0.98f;

float mean_around(const std::vector<float>& value, int width, int height, int x, int y,
                  int spread) {
  double sum = 0;
  int count = 0;
  for (int qy = std::max(0, y - outlier_reach); qy <= std::min(height - 1, y + outlier_reach); ++qy)
    for (int qx = std::max(0, x - outlier_reach); qx <= std::min(width - 1, x + outlier_reach);
         ++qx) {
      if (std::abs(qx - x) <= spread && std::abs(qy - y) <= spread) continue;
      sum += double(std::abs(value[size_t(qy) * size_t(width) + size_t(qx)]));
      ++count;
    }
  return count > 0 ? float(sum / count) : 0.0f;
}

}  // namespace

std::vector<float> shared_pixels(const std::vector<float>& value,
                                 const std::vector<float>& even_part, int width, int height,
                                 int spread) {
  std::vector<float> shared(value.size(), 1.0f);
  const int excluded = std::min(spread, outlier_reach - 1);
  tbb::parallel_for(0, height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const size_t p = size_t(y) * size_t(width) + size_t(x);
      const float total = std::abs(value[p]), even = std::abs(even_part[p]);
      const float other = std::abs(value[p] - even_part[p]);
      if (!(total > 0) || std::max(even, other) < one_half_only * total) continue;
      if (total / far_beyond > mean_around(value, width, height, x, y, excluded)) shared[p] = 0.0f;
    }
  });
  return shared;
}

}  // namespace tessera
