#pragma once
/// Affine transforms over shutter time.

#include <vector>

#include <glm/glm.hpp>

namespace tessera {

/// A matrix keyed in shutter time t in [0, 1]. Between keys the matrix elements, and so the points
/// it maps, move linearly. Matrices act on column vectors: P_world = world_from_object * P_object.
class MovingTransform {
 public:
  MovingTransform() : times_{0.0f}, matrices_{glm::dmat4(1.0)} {}
  explicit MovingTransform(const glm::dmat4& matrix) : times_{0.0f}, matrices_{matrix} {}
  /// `times` ascending, as many as `matrices`, at least one.
  MovingTransform(std::vector<float> times, std::vector<glm::dmat4> matrices);

  bool moves() const { return matrices_.size() > 1; }
  const std::vector<float>& times() const { return times_; }
  const std::vector<glm::dmat4>& matrices() const { return matrices_; }
  /// Element-wise linear between keys, held outside them.
  glm::dmat4 at(float t) const;

  /// a(t) * b(t), keyed at the union of both key times.
  static MovingTransform product(const MovingTransform& a, const MovingTransform& b);

 private:
  std::vector<float> times_;
  std::vector<glm::dmat4> matrices_;
};

/// The sorted union of ascending key times within [0, 1]; {0} if both hold a single key.
std::vector<float> merged_key_times(const std::vector<float>& a, const std::vector<float>& b);

}  // namespace tessera
