#include "reconstruct/bounded_values.h"

#include <cmath>
#include <limits>

namespace tessera {
namespace {

uint64_t bound_channel(std::vector<float>& values) {
  uint64_t count = 0;
  for (float& value : values) {
    if (std::isfinite(value)) continue;
    ++count;
    value = std::isnan(value) ? 0.0f : std::copysign(std::numeric_limits<float>::max(), value);
  }
  return count;
}

}  // namespace

uint64_t bound_values(const std::vector<const AovDefinition*>& groups, Image& image) {
  uint64_t count = 0;
  size_t channel = 0;
  for (const AovDefinition* group : groups) {
    const bool bounded = group->filter == ChannelFilter::filtered;
    for (size_t c = 0; c < group->channels.size(); ++c, ++channel)
      if (bounded) count += bound_channel(image.channels[channel].values);
  }
  return count;
}

}  // namespace tessera
