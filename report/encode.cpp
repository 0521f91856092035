#include "report/encode.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include <Imath/half.h>
#include <zlib.h>

#include "base/error.h"

namespace tessera {
namespace {

using Bytes = std::vector<uint8_t>;

uint16_t half_bits(float value) {
  constexpr float largest = 65504.0f;
  if (std::isfinite(value)) value = std::clamp(value, -largest, largest);
  return Imath::half(value).bits();
}

/// Appends the bytes of `words`, the highest of all first. `Word`: an unsigned integer.
template <typename Word>
void append_byte_planes(std::span<const Word> words, Bytes& bytes) {
  for (int shift = 8 * (int(sizeof(Word)) - 1); shift >= 0; shift -= 8)
    for (const Word word : words) bytes.push_back(uint8_t(word >> shift));
}

/// Replaces each entry by its difference from the one before.
void take_differences(std::span<uint16_t> plane) {
  uint16_t before = 0;
  for (uint16_t& entry : plane) {
    const uint16_t value = entry;
    entry = uint16_t(value - before);
    before = value;
  }
}

Bytes deflated(std::span<const uint8_t> bytes) {
  uLongf size = compressBound(uLong(bytes.size()));
  Bytes out(size);
  if (compress2(out.data(), &size, bytes.data(), uLong(bytes.size()), 6) != Z_OK)
    throw Error(fmt::format("cannot compress an image of {} bytes", bytes.size()));
  out.resize(size);
  return out;
}

const std::vector<float>& values_of(const Image& image, std::string_view name) {
  const Image::Channel* channel = image.find_channel(name);
  if (!channel) throw Error(fmt::format("the image has no channel '{}'", name));
  return channel->values;
}

EncodedImage encoded(const Image& image, std::span<const uint8_t> bytes) {
  return {image.width(), image.height(), base64(deflated(bytes))};
}

}  // namespace

EncodedImage encode_colour(const Image& image) {
  const std::vector<float>& green = values_of(image, "G");
  const size_t count = green.size();
  std::vector<uint16_t> green_bits(count), plane(count);
  std::transform(green.begin(), green.end(), green_bits.begin(), half_bits);

  Bytes bytes;
  bytes.reserve(count * 6);
  plane = green_bits;
  take_differences(plane);
  append_byte_planes<uint16_t>(plane, bytes);
  for (const char* name : {"R", "B"}) {
    const std::vector<float>& values = values_of(image, name);
    for (size_t i = 0; i < count; ++i) plane[i] = uint16_t(half_bits(values[i]) - green_bits[i]);
    take_differences(plane);
    append_byte_planes<uint16_t>(plane, bytes);
  }
  return encoded(image, bytes);
}

EncodedImage encode_scalar(const Image& image, std::string_view channel) {
  const std::vector<float>& values = values_of(image, channel);
  std::vector<uint32_t> words(values.size());
  std::transform(values.begin(), values.end(), words.begin(),
                 [](float value) { return std::bit_cast<uint32_t>(value); });
  Bytes bytes;
  bytes.reserve(words.size() * 4);
  append_byte_planes<uint32_t>(words, bytes);
  return encoded(image, bytes);
}

std::string base64(std::span<const uint8_t> bytes) {
  constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (size_t i = 0; i < bytes.size(); i += 3) {
    const size_t left = std::min<size_t>(3, bytes.size() - i);
    uint32_t group = 0;
    for (size_t k = 0; k < 3; ++k) group = group << 8 | (k < left ? bytes[i + k] : 0u);
    for (size_t k = 0; k < 4; ++k) text += k <= left ? digits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

}  // namespace tessera
