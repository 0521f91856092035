#include "images/preview.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"

namespace tessera {
namespace {

uint8_t code8(float value) { return uint8_t(std::clamp(value, 0.0f, 1.0f) * 255.0f + 0.5f); }

}  // namespace

uint8_t srgb8_from_linear(float linear) {
  if (!(linear > 0.0f)) return 0;
  if (linear <= 0.0031308f) return code8(12.92f * linear);
  return code8(1.055f * std::pow(std::min(linear, 1.0f), 1.0f / 2.4f) - 0.055f);
}

float linear_from_srgb(float code) {
  return code <= 0.04045f ? code / 12.92f : std::pow((code + 0.055f) / 1.055f, 2.4f);
}

Preview make_preview(const Image& image, bool keep_alpha) {
  if (image.channels.empty()) throw Error("an image without channels has no preview");
  std::array<const Image::Channel*, 3> rgb{image.find_channel("R"), image.find_channel("G"),
                                           image.find_channel("B")};
  if (!rgb[0] || !rgb[1] || !rgb[2]) rgb.fill(&image.channels.front());
  const Image::Channel* alpha = keep_alpha ? image.find_channel("A") : nullptr;

  Preview preview{image.width(), image.height(), alpha ? 4 : 3, {}};
  const size_t count = size_t(image.data_window.pixel_count());
  preview.pixels.reserve(count * size_t(preview.channels));
  for (size_t i = 0; i < count; ++i) {
    const float a = alpha ? alpha->values[i] : 1.0f;
    for (const Image::Channel* channel : rgb)
      preview.pixels.push_back(srgb8_from_linear(a > 0.0f ? channel->values[i] / a : 0.0f));
    if (alpha) preview.pixels.push_back(a > 0.0f ? code8(a) : uint8_t(0));
  }
  return preview;
}

}  // namespace tessera
