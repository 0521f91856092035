#include "reconstruct/sample_block.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tessera {
namespace {

bool all_finite(const std::vector<float>& values) {
  // Written without a branch, so that it runs at the speed of memory.
  bool finite = true;
  for (const float value : values) finite &= std::abs(value) <= std::numeric_limits<float>::max();
  return finite;
}

}  // namespace

/// weights[offset][sample] along one axis, offsets from -reach to reach. `positions` go through the
/// samples pixel by pixel: pixel p's own coordinate is pixel_of(p).
template <class PixelOf>
std::vector<float> WeightedBlock::axis_weights(const std::vector<float>& positions,
                                               const FilterTable& table, PixelOf pixel_of) const {
  const int reach = table.reach_pixels();
  const size_t pixels = size_t(rect().pixel_count());
  std::vector<float> weights(size_t(2 * reach + 1) * positions.size());
  float* out = weights.data();
  for (int offset = -reach; offset <= reach; ++offset) {
    for (size_t p = 0; p < pixels; ++p) {
      const float centre = float(pixel_of(p) + offset) + 0.5f;
      for (size_t k = first_of(p); k < first_of(p + 1); ++k) *out++ = table(positions[k] - centre);
    }
  }
  return weights;
}

WeightedBlock::WeightedBlock(SampleValues&& values, const std::vector<const AovDefinition*>& groups,
                             const FilterTable& x_table, const FilterTable& y_table,
                             uint64_t& dropped)
    : values_(std::move(values)),
      sample_count_(values_.x.size()),
      x_reach_(x_table.reach_pixels()),
      y_reach_(y_table.reach_pixels()) {
  const size_t width = size_t(rect().width());
  x_weights_ =
      axis_weights(values_.x, x_table, [&](size_t p) { return rect().x0 + int(p % width); });
  y_weights_ =
      axis_weights(values_.y, y_table, [&](size_t p) { return rect().y0 + int(p / width); });
  if (!values_.first_of_pixel.empty()) even_out_pixels();
  if (!std::all_of(values_.groups.begin(), values_.groups.end(), all_finite) ||
      !all_finite(values_.carried))
    drop_nonfinite(groups, dropped);
  values_.x = {}, values_.y = {};
}

/// Each pixel of the frame counts alike, however many samples it has.
void WeightedBlock::even_out_pixels() {
  for (size_t p = 0; p < size_t(rect().pixel_count()); ++p) {
    const size_t first = first_of(p), end = first_of(p + 1);
    const float share = float(values_.samples_per_pixel) / float(std::max<size_t>(end - first, 1));
    for (size_t row = 0; row < x_weights_.size(); row += sample_count_)
      for (size_t k = first; k < end; ++k) x_weights_[row + k] *= share;
  }
}

/// A sample that is not finite in any channel counts for none: its weight and its filtered values
/// become 0, its closest values those of the background.
void WeightedBlock::drop_nonfinite(const std::vector<const AovDefinition*>& groups,
                                   uint64_t& dropped) {
  for (size_t s = 0; s < sample_count_; ++s) {
    if (finite(s)) continue;
    ++dropped;
    for (size_t g = 0; g < groups.size(); ++g)
      for (size_t c = 0; c < groups[g]->channels.size(); ++c)
        values_.groups[g][c * sample_count_ + s] =
            groups[g]->filter == ChannelFilter::closest ? groups[g]->background : 0.0f;
    for (size_t k = s; k < values_.carried.size(); k += sample_count_) values_.carried[k] = 0.0f;
    for (size_t k = s; k < x_weights_.size(); k += sample_count_) x_weights_[k] = 0.0f;
  }
}

bool WeightedBlock::finite(size_t sample) const {
  for (const std::vector<float>& group : values_.groups)
    for (size_t k = sample; k < group.size(); k += sample_count_)
      if (!std::isfinite(group[k])) return false;
  for (size_t k = sample; k < values_.carried.size(); k += sample_count_)
    if (!std::isfinite(values_.carried[k])) return false;
  return true;
}

}  // namespace tessera
