#pragma once
/// Channel groups by name, and how many channels there may be.

#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "shade/shade.h"

namespace tessera {

/// Place of the group called `name`, or -1.
inline int find_group(const std::vector<const AovDefinition*>& groups, std::string_view name) {
  for (size_t g = 0; g < groups.size(); ++g)
    if (name == groups[g]->name) return int(g);
  return -1;
}

/// Channels that one frame may filter: more than every group together has.
inline constexpr size_t max_channels = 1024;

/// Throws Error if there are more.
inline void check_channels(const std::vector<const AovDefinition*>& groups) {
  size_t channels = 0;
  for (const AovDefinition* group : groups) channels += group->channels.size();
  if (channels > max_channels)
    throw Error(fmt::format("{} channels asked for, at most {} can be", channels, max_channels));
}

}  // namespace tessera
