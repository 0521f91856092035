#pragma once
// Compares images bit by bit.

#include <bit>
#include <cstdint>

#include <catch2/catch.hpp>

#include "images/image.h"

namespace tessera {

/// Values whose bits differ, over all channels; both images must have the same.
inline size_t differing_values(const Image& a, const Image& b) {
  REQUIRE(a.data_window == b.data_window);
  REQUIRE(a.channels.size() == b.channels.size());
  size_t count = 0;
  for (const Image::Channel& channel : a.channels) {
    const Image::Channel* other = b.find_channel(channel.name);
    REQUIRE(other);
    for (size_t i = 0; i < other->values.size(); ++i)
      count +=
          std::bit_cast<uint32_t>(channel.values[i]) != std::bit_cast<uint32_t>(other->values[i]);
  }
  return count;
}

}  // namespace tessera
