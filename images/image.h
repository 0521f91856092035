#pragma once
/// An image in memory: named planar float channels over a rectangle of pixels.

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/raster.h"

namespace tessera {

/// How a channel is kept in a file; in memory all are floats. Integers (object ids) are kept as
/// floats, exact up to 2^24, as most compositing programs expect.
enum class PixelType { half, float32 };

struct Image {
  struct Channel {
    std::string name;  ///< as in OpenEXR: R, G, B, A, Z, N.x, ...
    PixelType type = PixelType::float32;
    std::vector<float> values;  ///< row after row of the data window
  };

  PixelRect display_window;  ///< the whole picture
  PixelRect data_window;     ///< the pixels held: the crop
  double pixel_aspect = 1.0;
  std::vector<Channel> channels;
  std::map<std::string, std::string> metadata;
  /// 4 x 4 matrices as OpenEXR keeps them: row after row, for row vectors (P' = P M), so that the
  /// last row is the translation.
  std::map<std::string, std::array<float, 16>> matrices;

  Image() = default;
  /// A picture all of whose pixels are held, with its top left at (0, 0).
  Image(int width, int height) : display_window{0, 0, width, height}, data_window(display_window) {}
  Image(const PixelRect& display, const PixelRect& data)
      : display_window(display), data_window(data) {}

  int width() const { return data_window.width(); }
  int height() const { return data_window.height(); }
  /// Place of pixel (x, y), given in the coordinates of the display window, in a channel's values.
  size_t index(int x, int y) const {
    return size_t(y - data_window.y0) * size_t(width()) + size_t(x - data_window.x0);
  }

  /// Appends a channel filled with `value`. The reference holds until the next channel is added.
  Channel& add_channel(std::string name, PixelType type = PixelType::float32, float value = 0.0f) {
    channels.push_back(
        {std::move(name), type, std::vector<float>(size_t(data_window.pixel_count()), value)});
    return channels.back();
  }
  /// The channel called `name`, or null.
  const Channel* find_channel(std::string_view name) const {
    for (const Channel& channel : channels)
      if (channel.name == name) return &channel;
    return nullptr;
  }
};

}  // namespace tessera
