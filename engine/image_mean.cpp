#include "engine/image_mean.h"

#include <vector>

namespace tessera {

void take_closest(std::span<const AovDefinition* const> groups, const Image& from, Image& to) {
  const Image::Channel *z_to = to.find_channel("Z"), *z_from = from.find_channel("Z");
  if (!z_to || !z_from) return;
  std::vector<size_t> nearer;
  for (size_t p = 0; p < z_to->values.size(); ++p)
    if (z_from->values[p] < z_to->values[p]) nearer.push_back(p);
  size_t channel = 0;
  for (const AovDefinition* group : groups)
    for (size_t c = 0; c < group->channels.size(); ++c, ++channel)
      if (group->filter == ChannelFilter::closest)
        for (const size_t p : nearer)
          to.channels[channel].values[p] = from.channels[channel].values[p];
}

void average(std::span<const AovDefinition* const> groups, const Image& from, double share,
             Image& to) {
  size_t channel = 0;
  for (const AovDefinition* group : groups)
    for (size_t c = 0; c < group->channels.size(); ++c, ++channel) {
      if (group->filter != ChannelFilter::filtered) continue;
      std::vector<float>& values = to.channels[channel].values;
      const std::vector<float>& other = from.channels[channel].values;
      for (size_t p = 0; p < values.size(); ++p)
        values[p] = float((1 - share) * double(values[p]) + share * double(other[p]));
    }
}

}  // namespace tessera
