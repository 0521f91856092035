#pragma once
/// Lengths of what passes through the frame between two motion keys.

#include <array>
#include <cstdint>
#include <span>

#include "dice/least_blur.h"
#include "dice/projection.h"

namespace tessera {

/// A camera-space segment whose ends move linearly from one motion key to the next.
struct MovingSegment {
  glm::vec3 a0, b0;  ///< ends at the first key
  glm::vec3 a1, b1;  ///< ends at the second key
};

/// Upper estimate in pixels of the RasterProjection::segment_length() of a moving segment at both
/// keys and in between. What is in the frame for a part of the way is measured when it enters, when
/// it leaves and halfway; after turn_to_eye() also when its ends and its middle pass the eye.
float longest_length(const RasterProjection& projection, const MovingSegment& s);

/// Samples of a curve or a piece at the last two motion keys. In a whip pan they may be beside the
/// frame at both, where lengths hardly count, and fill it in between.
class Passage {
 public:
  explicit Passage(const RasterProjection& projection) : projection_(projection) {}

  /// `P_camera`: at most LeastBlur::most_samples points, the same ones in the same order at every
  /// key.
  void add_key(std::span<const glm::vec3> P_camera);

  /// Whether any length may be more between the last two keys than at them. False after one key,
  /// and for what stays in the frame or beyond one of its sides.
  bool matters() const;

  /// longest_length() from sample i to sample j, between the last two keys.
  float length(size_t i, size_t j) const {
    return longest_length(projection_, {from_[i], from_[j], to_[i], to_[j]});
  }

 private:
  /// The sides of the frame that any, and that all, of the samples at a key are beyond, as bits.
  struct Sides {
    uint32_t any = 0, all = 0;
  };

  const RasterProjection& projection_;
  std::array<glm::vec3, LeastBlur::most_samples> from_, to_;
  Sides from_sides_, to_sides_;
  int keys_ = 0;
};

}  // namespace tessera
