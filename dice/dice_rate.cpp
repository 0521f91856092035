#include "dice/dice_rate.h"

#include <algorithm>
#include <cmath>

namespace tessera {

namespace {

int ceiling(float x) { return int(std::ceil(std::clamp(x, 1.0f, 1e6f))); }

/// Blur at which a factor of 1 begins to coarsen.
constexpr float reference_blur_pixels = 16;
/// A micropolygon's side never exceeds this part of the blur.
constexpr float largest_part_of_blur = 1.0f / 4;
/// Deviation from the curve that is allowed whatever the blur: motion hides nothing across itself.
constexpr float sharp_sag_pixels = 1.0f / 32;
/// Defocus hides in every direction: this part of the circle's diameter.
constexpr float sag_part_of_focus = 1.0f / 128;

float grown(float step, float factor, float blur_pixels) {
  const float by_area =
      step * std::sqrt(std::max(1.0f, factor * blur_pixels / reference_blur_pixels));
  return std::max(step, std::min(by_area, blur_pixels * largest_part_of_blur));
}

}  // namespace

void RowSize::add(const RowLength& row) {
  length = std::max(length, std::min(float(pieces) * row.longest, 2 * row.sum));
  most = std::max(most, float(pieces) * row.longest);
}

void RowSize::add_bend(const RasterProjection& projection, const glm::vec3& a, const glm::vec3& b,
                       const glm::vec3& c) {
  const glm::vec3 chord = c - a, side = b - a;
  const float chord_length = glm::length(chord);
  // Across the chord: what is uneven along a straight line is no bend.
  const float deviation =
      chord_length > 0 ? glm::length(glm::cross(chord, side)) / chord_length : glm::length(side);
  const RasterClipMap& map = projection.map();
  const float w = map.w_from_z * b.z + map.w_constant;
  const float off = deviation * std::max(std::abs(map.x_scale), std::abs(map.y_scale)) / w;
  if (off > bend) bend = off;  // false for what is not a number: then the blur is unknown, too
}

RowSegments segments_of(const RowSize& size, const DiceStep& step) {
  RowSegments full{ceiling(size.length / step.full), ceiling(size.most / step.full)};
  if (!step.is_coarse()) return full;
  // A polyline of n segments deviates by bend (pieces / 2 n)^2.
  const int flat = ceiling(0.5f * float(size.pieces) * std::sqrt(size.bend / step.sag));
  const auto coarse = [&](float pixels, int at_full_rate) {
    return std::min(at_full_rate, std::max(ceiling(pixels / step.blurred), flat));
  };
  return {coarse(size.length, full.count), coarse(size.most, full.most)};
}

DiceStep DiceRate::step_under(const LeastBlur& blur) const {
  const float motion = motion_factor > 0 ? blur.motion_pixels() : 0.0f;
  const float focus = focus_factor > 0 ? blur.focus_pixels() : 0.0f;
  return {step, std::max(grown(step, motion_factor, motion), grown(step, focus_factor, focus)),
          std::max(sharp_sag_pixels, focus * sag_part_of_focus)};
}

}  // namespace tessera
