#pragma once
/// The blur that every point of a curve or of a piece receives at least, on the raster.

#include <array>
#include <span>

#include "dice/projection.h"

namespace tessera {

/// Measures samples of a curve or a piece, given key by key. Between samples the surface is taken
/// to lie in their hull, as it does where dicing measures lengths.
///
/// Blur is only claimed where it is sure. A part that is sharp for a while, while it rests between
/// two keys, while it passes the focal plane, or because its neighbours move in opposite directions
/// around it, is sharp; where a sample comes near the camera plane nothing is known, and the blur
/// is zero.
class LeastBlur {
 public:
  static constexpr size_t most_samples = 81;

  /// `P_camera`: at most most_samples points, the same ones in the same order at every key, keys
  /// ascending in shutter time `t`, from 0.
  void add_key(const RasterProjection& projection, float t, std::span<const glm::vec3> P_camera);

  /// Length in pixels that the motion draws every point out to while the shutter is open: that of
  /// the slowest time, and not more than the points get away from where they were at first.
  float motion_pixels() const;
  /// Diameter in pixels of the least circle of confusion.
  float focus_pixels() const;

 private:
  std::array<glm::vec2, most_samples> first_, previous_;  ///< raster positions at lens centre
  size_t keys_ = 0;
  float previous_t_ = 0;
  float slowest_ = 0, farthest_ = 0;    ///< pixels a shutter; pixels
  float least_coc_ = 0, most_coc_ = 0;  ///< signed radii in pixels
  bool known_ = true;
};

}  // namespace tessera
