#pragma once
/// The unit square as concentric squares about its centre: area-preserving, continuous, of bounded
/// stretch. Rescaling the squares to circles gives the concentric map of Shirley and Chiu, "A Low
/// Distortion Map Between Disk and Square" (1997); rescaling them to polygons gives polygons.

#include <cmath>

namespace tessera {

/// `radius` in [0, 1]; `turn` in [0, 1) counts once around the square at constant speed, from +x
/// towards +y. The area element is radius * d radius * d turn, times a constant.
struct ConcentricPoint {
  float radius, turn;
};

inline ConcentricPoint concentric_from_square(float a, float b) {
  const float x = 2.0f * a - 1.0f, y = 2.0f * b - 1.0f;
  if (x == 0.0f && y == 0.0f) return {0.0f, 0.0f};
  float turn;
  if (std::abs(x) > std::abs(y))
    turn = (x > 0.0f ? 0.0f : 0.5f) + 0.125f * (y / x);
  else
    turn = (y > 0.0f ? 0.25f : 0.75f) - 0.125f * (x / y);
  if (turn < 0.0f) turn += 1.0f;
  return {std::fmax(std::abs(x), std::abs(y)), turn < 1.0f ? turn : 0.0f};
}

}  // namespace tessera
