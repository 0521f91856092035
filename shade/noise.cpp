#include "shade/noise.h"

#include <algorithm>
#include <cmath>

#include "base/hash.h"
#include "shade/mathematics.h"
#include "shade/pattern_points.h"

namespace tessera {
namespace {

constexpr float largest_coordinate = 1e8f;
constexpr int most_octaves = 16;
/// Mean of |gradient_noise| over space, by integration over 2^24 random points; tested.
constexpr float mean_absolute_noise = 0.2201f;

/// The dot product of `offset` with one of the twelve directions to the edges of a cube, picked by
/// the lattice point. Directions on edges have no bias along the axes (K. Perlin, "Improving
/// noise", SIGGRAPH 2002).
float lattice_gradient(int x, int y, int z, const glm::vec3& offset) {
  const uint32_t h = hash_combine(hash_combine(mix32(uint32_t(x)), uint32_t(y)), uint32_t(z));
  const float a = (h & 1u) ? -1.0f : 1.0f, b = (h & 2u) ? -1.0f : 1.0f;
  switch ((h >> 2) % 3u) {
    case 0:
      return a * offset.x + b * offset.y;
    case 1:
      return a * offset.y + b * offset.z;
    default:
      return a * offset.z + b * offset.x;
  }
}

/// Interpolation weight whose first and second derivatives vanish at 0 and 1.
float quintic(float t) { return t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f); }

float mix(float a, float b, float t) { return a + (b - a) * t; }

}  // namespace

float gradient_noise(const glm::vec3& p) {
  const bool resolved = std::abs(p.x) < largest_coordinate && std::abs(p.y) < largest_coordinate &&
                        std::abs(p.z) < largest_coordinate;
  if (!resolved) return 0.0f;
  const glm::vec3 cell = glm::floor(p), f = p - cell;
  const int x = int(cell.x), y = int(cell.y), z = int(cell.z);
  float corner[2][2][2];
  for (int k = 0; k < 2; ++k) {
    for (int j = 0; j < 2; ++j) {
      for (int i = 0; i < 2; ++i) {
        corner[k][j][i] = lattice_gradient(x + i, y + j, z + k, f - glm::vec3(i, j, k));
      }
    }
  }
  const float u = quintic(f.x), v = quintic(f.y), w = quintic(f.z);
  const float near_side =
      mix(mix(corner[0][0][0], corner[0][0][1], u), mix(corner[0][1][0], corner[0][1][1], u), v);
  const float far_side =
      mix(mix(corner[1][0][0], corner[1][0][1], u), mix(corner[1][1][0], corner[1][1][1], u), v);
  return std::clamp(mix(near_side, far_side, w), -1.0f, 1.0f);
}

float octave_share(float footprint, float frequency) {
  return 1.0f - smoothstep(0.25f, 0.75f, footprint * frequency);
}

int octave_count(float asked) {
  // Before the conversion, which is undefined out of the range of int; fmax takes NaN to 0.
  return int(std::fmin(std::fmax(asked, 0.0f), float(most_octaves)));
}

float fractal_noise(const glm::vec3& p, float footprint, int octaves) {
  float sum = 0.0f, frequency = 1.0f;
  for (int k = 0; k < std::min(octaves, most_octaves); ++k, frequency *= 2.0f) {
    const float share = octave_share(footprint, frequency);
    if (share <= 0.0f) break;
    sum += share * gradient_noise(p * frequency) / frequency;
  }
  return sum;
}

float turbulence(const glm::vec3& p, float footprint, int octaves) {
  float sum = 0.0f, frequency = 1.0f;
  for (int k = 0; k < std::min(octaves, most_octaves); ++k, frequency *= 2.0f) {
    const float share = octave_share(footprint, frequency);
    const float shown = share > 0.0f ? std::abs(gradient_noise(p * frequency)) : 0.0f;
    sum += mix(mean_absolute_noise, shown, share) / frequency;
  }
  return sum;
}

float filtered_square_wave(float x, float width) {
  const auto wrapped = [](float value) { return value - 2.0f * std::floor(value * 0.5f); };
  // Below this the difference of integrals loses more to rounding than the box filters.
  if (!(width > 1e-3f)) return wrapped(x) < 1.0f ? 1.0f : -1.0f;
  // The integral of the wave is a triangle wave of the same period, so whole periods cancel and
  // only the remainders of the two ends matter.
  const auto integral = [&](float value) {
    const float w = wrapped(value);
    return w < 1.0f ? w : 2.0f - w;
  };
  // Wrapping is exact, and far from the origin half a width would be lost in x itself.
  const float near = wrapped(x);
  return (integral(near + 0.5f * width) - integral(near - 0.5f * width)) / width;
}

float filtered_checker(glm::vec2 st, glm::vec2 width) {
  return 0.5f + 0.5f * filtered_square_wave(st.x, width.x) * filtered_square_wave(st.y, width.y);
}

float checker_over_cell(glm::vec2 st, glm::vec2 x, glm::vec2 y) {
  const CellAxes<glm::vec2> axes = principal_axes(x, y);
  const glm::vec2 length = glm::abs(axes.major), width = glm::abs(axes.minor);
  // A cell that is long in one of s and t only is close to a box already.
  const int taps = std::min(taps_along(length.x, width.x), taps_along(length.y, width.y));
  if (taps == 1) return filtered_checker(st, glm::abs(x) + glm::abs(y));
  // The part of the cell around a tap is a parallelogram too: a box with its variances.
  const glm::vec2 part = glm::sqrt(length * length / float(taps * taps) + width * width);
  float sum = 0.0f;
  for (int tap = 0; tap < taps; ++tap) {
    const float offset = (float(tap) + 0.5f) / float(taps) - 0.5f;
    sum += filtered_checker(st + offset * axes.major, part);
  }
  return sum / float(taps);
}

}  // namespace tessera
