#include "reconstruct/outliers.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

namespace tessera {
namespace {

constexpr float far_beyond = 1000.0f;
constexpr float one_half_only = 0.98f;
/// Where others are alike, but most are not, it takes more: rare light in the dark, which filters
/// are for, is not to be taken for it.
constexpr float far_beyond_most = 1e6f, alike = 1e-4f;

/// The pixels around one without those within `spread`.
struct Around {
  double sum = 0, dim_sum = 0;
  int count = 0, dim_count = 0;  ///< dim: not near as bright as the one

  void add(float value, float total) {
    sum += double(value), ++count;
    if (value <= alike * total) dim_sum += double(value), ++dim_count;
  }
  bool far_below(float total) const {
    return count == 0 || double(total) > double(far_beyond) * sum / count;
  }
  bool most_far_below(float total) const {
    if (2 * dim_count <= count || !(dim_sum > 0)) return false;
    return double(total) > double(far_beyond_most) * dim_sum / dim_count;
  }
};

Around around(const std::vector<float>& value, int width, int height, int x, int y, int spread) {
  Around result;
  const float total = std::abs(value[size_t(y) * size_t(width) + size_t(x)]);
  for (int qy = std::max(0, y - outlier_reach); qy <= std::min(height - 1, y + outlier_reach); ++qy)
    for (int qx = std::max(0, x - outlier_reach); qx <= std::min(width - 1, x + outlier_reach);
         ++qx) {
      if (std::abs(qx - x) <= spread && std::abs(qy - y) <= spread) continue;
      result.add(std::abs(value[size_t(qy) * size_t(width) + size_t(qx)]), total);
    }
  return result;
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
      if (!(total > 0)) continue;
      const bool of_one_half = std::max(even, other) >= one_half_only * total;
      const Around near = around(value, width, height, x, y, excluded);
      if ((of_one_half && near.far_below(total)) || near.most_far_below(total)) shared[p] = 0.0f;
    }
  });
  return shared;
}

}  // namespace tessera
