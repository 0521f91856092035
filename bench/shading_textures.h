#pragma once
/// Pictures for the scenes of bench/shading.cpp: linear, with detail down to the texel.

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <string_view>

#include <glm/glm.hpp>

#include "base/hash.h"
#include "images/exr.h"

namespace tessera {

namespace shading_textures {

/// In [0, 1], from the lattice point alone.
inline float lattice_noise(int x, int y, uint32_t seed) {
  return float(hash_combine(hash_combine(seed, uint32_t(x)), uint32_t(y)) >> 8) / float(1 << 24);
}

/// Value noise of several octaves in [0, 1], periodic over `size` texels.
inline float cloud(int x, int y, int size, int period, uint32_t seed) {
  float sum = 0, weight = 0.5f;
  for (; period >= 1; period /= 2, weight *= 0.5f) {
    const int cells = size / period, cx = x / period, cy = y / period;
    const float fx = float(x % period) / float(period), fy = float(y % period) / float(period);
    const auto at = [&](int i, int j) {
      return lattice_noise((cx + i) % cells, (cy + j) % cells, seed + uint32_t(period));
    };
    sum +=
        weight * glm::mix(glm::mix(at(0, 0), at(1, 0), fx), glm::mix(at(0, 1), at(1, 1), fx), fy);
  }
  return sum;
}

using Painter = std::function<glm::vec3(int x, int y)>;

inline void write(const std::string& path, int width, int height, const Painter& paint) {
  Image image(width, height);
  for (const char* name : {"R", "G", "B"}) image.add_channel(name, PixelType::half);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const glm::vec3 color = paint(x, y);
      for (int c = 0; c < 3; ++c) image.channels[size_t(c)].values[image.index(x, y)] = color[c];
    }
  write_exr(path, image);
}

/// Courses of blocks, every other one shifted by half a block, with dark joints.
inline glm::vec3 masonry(int x, int y, int size, glm::ivec2 block, int joint,
                         const glm::vec3& stone, float variety, uint32_t seed) {
  const int row = y / block.y, shifted = (x + (row % 2) * block.x / 2) % size;
  const int column = shifted / block.x;
  const bool in_joint = shifted % block.x < joint || y % block.y < joint;
  const float grain = cloud(x, y, size, 32, seed);
  if (in_joint) return glm::vec3(0.12f, 0.11f, 0.1f) * (0.6f + 0.8f * grain);
  const float tone = 1.0f + variety * (lattice_noise(column, row, seed) - 0.5f);
  const glm::vec3 tint = glm::mix(glm::vec3(1), glm::vec3(1.1f, 0.9f, 0.75f),
                                  variety * lattice_noise(column, row, seed + 7));
  return stone * tint * tone * (0.55f + 0.9f * grain);
}

/// Letters five texels wide and seven high: a row each, the leftmost in bit 4.
inline std::array<uint8_t, 7> glyph(char letter) {
  switch (letter) {
    case 'A':
      return {14, 17, 17, 31, 17, 17, 17};
    case 'B':
      return {30, 17, 17, 30, 17, 17, 30};
    case 'C':
      return {14, 17, 16, 16, 16, 17, 14};
    case 'D':
      return {30, 17, 17, 17, 17, 17, 30};
    case 'E':
      return {31, 16, 16, 30, 16, 16, 31};
    case 'I':
      return {14, 4, 4, 4, 4, 4, 14};
    case 'K':
      return {17, 18, 20, 24, 20, 18, 17};
    case 'L':
      return {16, 16, 16, 16, 16, 16, 31};
    case 'M':
      return {17, 27, 21, 21, 17, 17, 17};
    case 'N':
      return {17, 25, 21, 19, 17, 17, 17};
    case 'O':
      return {14, 17, 17, 17, 17, 17, 14};
    case 'R':
      return {30, 17, 17, 30, 20, 18, 17};
    case 'S':
      return {15, 16, 16, 14, 1, 1, 30};
    case 'T':
      return {31, 4, 4, 4, 4, 4, 4};
    case 'V':
      return {17, 17, 17, 17, 17, 10, 4};
    default:
      return {};
  }
}

/// Whether texel (x, y) of a line of text is inked, in units of a letter's texels from its top
/// left.
inline bool inked(std::string_view text, int x, int y) {
  if (x < 0 || y < 0 || y >= 7 || x / 6 >= int(text.size()) || x % 6 == 5) return false;
  return glyph(text[size_t(x / 6)])[size_t(y)] >> (4 - x % 6) & 1;
}

/// A board with a frame, a large word and lines of small print.
inline glm::vec3 board(int x, int y, int width, int height, std::string_view word,
                       const glm::vec3& ground, const glm::vec3& ink) {
  const int margin = 10, edge = std::min({x, y, width - 1 - x, height - 1 - y});
  if (edge < margin) return edge / 3 % 2 ? ink : ground * 0.4f;
  const int big = (width - 4 * margin) / (6 * int(word.size())), top = height / 6;
  const int left = (width - big * (6 * int(word.size()) - 1)) / 2;
  if (x >= left && y >= top && inked(word, (x - left) / big, (y - top) / big)) return ink;
  const int small = 3, first_line = top + 8 * big;
  const std::string_view print = "BREAD SALT IRON CANDLES NETS BOOKS TOOLS";
  const int line = (y - first_line) / (10 * small);
  if (y >= first_line && y < height - 3 * margin && x >= 2 * margin && x < width - 3 * margin) {
    const std::string_view shifted = print.substr(size_t(line * 5 % 20));
    if (inked(shifted, (x - 2 * margin) / small, (y - first_line) % (10 * small) / small))
      return ink;
  }
  return ground * (0.9f + 0.2f * lattice_noise(x / 4, y / 40, 5));
}

/// Overlapping round scales with dark rims, lighter in the middle.
inline glm::vec3 scales(int x, int y, const glm::vec3& base, int size) {
  const int cell = 16, row = y / (cell / 2);
  const float fx = float((x + (row % 2) * cell / 2) % cell) / float(cell) - 0.5f;
  const float fy = float(y % (cell / 2)) / float(cell);
  const float r = std::sqrt(fx * fx + fy * fy);
  const float rim = std::clamp((0.5f - r) * 5.0f, 0.25f, 1.0f);
  const float tone = 0.7f + 0.6f * cloud(x, y, size, 64, 11);
  return base * rim * tone * 1.3f;
}

/// Plates with rivets, lines and a few lamps.
inline glm::vec3 panels(int x, int y, int size) {
  const int plate = 64, px = x % plate, py = y % plate;
  if (px < 2 || py < 2) return glm::vec3(0.05f);
  const float tone = 0.75f + 0.5f * lattice_noise(x / plate, y / plate, 3);
  const int corner = std::max(std::min(px, plate - px), 0), side = std::min(py, plate - py);
  if (corner > 4 && corner < 8 && side > 4 && side < 8) return glm::vec3(0.75f);
  if (lattice_noise(x / plate, y / plate, 9) > 0.8f && py > 24 && py < 40 && px % 8 < 4)
    return {0.9f, 0.55f, 0.1f};
  return glm::vec3(0.36f, 0.4f, 0.45f) * tone * (0.8f + 0.4f * cloud(x, y, size, 8, 21));
}

}  // namespace shading_textures

/// Words on the boards, each in board_WORD.exr.
inline constexpr const char* shading_board_words[] = {"TAVERN", "MARKET", "BOOKS", "CITADEL",
                                                      "SALT"};

/// Writes wall.exr, brick.exr, paving.exr, scales.exr, panels.exr, cloth.exr and the boards.
inline void write_shading_textures(const std::string& folder) {
  using namespace shading_textures;
  constexpr int size = 512;
  write(folder + "/wall.exr", size, size, [](int x, int y) {
    return masonry(x, y, size, {128, 64}, 5, {0.62f, 0.52f, 0.38f}, 0.5f, 1);
  });
  write(folder + "/brick.exr", size, size, [](int x, int y) {
    return masonry(x, y, size, {64, 32}, 4, {0.55f, 0.24f, 0.15f}, 0.8f, 2);
  });
  write(folder + "/paving.exr", size, size, [](int x, int y) {
    return masonry(x, y, size, {64, 64}, 3, {0.5f, 0.45f, 0.37f}, 0.5f, 3);
  });
  write(folder + "/scales.exr", size, size, [](int x, int y) {
    return scales(x, y, {0.25f, 0.5f, 0.3f}, size);
  });
  write(folder + "/panels.exr", size, size, [](int x, int y) { return panels(x, y, size); });
  write(folder + "/cloth.exr", size, size, [](int x, int y) {
    const bool stripe = x / 32 % 2, thread = (x / 2 + y / 2) % 2;
    const glm::vec3 color = stripe ? glm::vec3(0.6f, 0.1f, 0.08f) : glm::vec3(0.75f, 0.68f, 0.5f);
    return color * (thread ? 1.0f : 0.75f);
  });
  const glm::vec3 grounds[] = {{0.8f, 0.7f, 0.45f},
                               {0.1f, 0.25f, 0.45f},
                               {0.75f, 0.75f, 0.7f},
                               {0.5f, 0.08f, 0.06f},
                               {0.1f, 0.3f, 0.15f}};
  const glm::vec3 inks[] = {{0.08f, 0.04f, 0.02f},
                            {0.9f, 0.85f, 0.6f},
                            {0.05f, 0.05f, 0.2f},
                            {0.95f, 0.85f, 0.5f},
                            {0.9f, 0.9f, 0.85f}};
  for (size_t k = 0; k < std::size(shading_board_words); ++k) {
    const std::string_view word = shading_board_words[k];
    write(folder + "/board_" + std::string(word) + ".exr", size, size / 2,
          [&](int x, int y) { return board(x, y, size, size / 2, word, grounds[k], inks[k]); });
  }
}

}  // namespace tessera
