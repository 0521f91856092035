#include "reconstruct/sample_block.h"

#include <cmath>

namespace tessera {
namespace {

/// weights[offset][sample] of `positions` along one axis, given each sample's own pixel.
template <class PixelOf>
std::vector<float> axis_weights(const std::vector<float>& positions, const FilterTable& table,
                                PixelOf pixel_of) {
  const int reach = table.reach_pixels();
  std::vector<float> weights;
  weights.reserve(size_t(2 * reach + 1) * positions.size());
  for (int offset = -reach; offset <= reach; ++offset)
    for (size_t s = 0; s < positions.size(); ++s)
      weights.push_back(table(positions[s] - (float(pixel_of(s) + offset) + 0.5f)));
  return weights;
}

}  // namespace

WeightedBlock::WeightedBlock(SampleValues&& values, const std::vector<const AovDefinition*>& groups,
                             const FilterTable& x_table, const FilterTable& y_table,
                             uint64_t& dropped)
    : values_(std::move(values)),
      sample_count_(values_.x.size()),
      x_reach_(x_table.reach_pixels()),
      y_reach_(y_table.reach_pixels()) {
  const size_t spp = size_t(values_.samples_per_pixel), width = size_t(rect().width());
  x_weights_ =
      axis_weights(values_.x, x_table, [&](size_t s) { return rect().x0 + int(s / spp % width); });
  y_weights_ =
      axis_weights(values_.y, y_table, [&](size_t s) { return rect().y0 + int(s / spp / width); });
  drop_nonfinite(groups, dropped);
  values_.x = {}, values_.y = {};
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
    for (size_t k = s; k < x_weights_.size(); k += sample_count_) x_weights_[k] = 0.0f;
  }
}

bool WeightedBlock::finite(size_t sample) const {
  for (const std::vector<float>& group : values_.groups)
    for (size_t k = sample; k < group.size(); k += sample_count_)
      if (!std::isfinite(group[k])) return false;
  return true;
}

}  // namespace tessera
