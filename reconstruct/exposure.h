#pragma once
/// Exposure of the RenderMan interface (3.2, section 4.2.3).

#include <cmath>

namespace tessera {

/// (gain * value)^(1 / gamma), with the sign of gain * value.
inline float exposed(float value, float gain, float gamma) {
  const float scaled = gain * value;
  if (gamma == 1.0f) return scaled;
  return std::copysign(std::pow(std::abs(scaled), 1.0f / gamma), scaled);
}

}  // namespace tessera
