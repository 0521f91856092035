#pragma once
/// A surface's control points in camera space at the keys of everything that moves it.

#include <vector>

#include <glm/glm.hpp>

#include "cameras/camera.h"
#include "scenes/scene.h"

namespace tessera {

/// Keys of a surface are the union of those of its geometry, its transform and the camera, with 0
/// and 1 added; one key, at 0, when none of them moves. Points are transformed on request: nothing
/// is stored per instance but matrices.
class MovingPoints {
 public:
  MovingPoints(const Surface& surface, const Camera& camera);

  const std::vector<float>& times() const { return times_; }
  int key_count() const { return int(times_.size()); }
  const glm::dmat4& camera_from_object(int key) const { return matrices_[size_t(key)]; }

  /// Control point `vertex` of the geometry, in camera space at `key`.
  glm::vec3 point(int key, int vertex) const;
  /// The same before the transform.
  glm::dvec3 point_object(int key, int vertex) const;
  /// Linear interpolation at `key` between the geometry's own keys of a value given for each.
  template <class Value>
  double interpolate(int key, const Value& value_of_geometry_key) const {
    const GeometryKey& at = geometry_keys_[size_t(key)];
    const double a = value_of_geometry_key(at.first);
    if (at.weight == 0) return a;
    return a + (value_of_geometry_key(at.first + 1) - a) * at.weight;
  }

  /// +1 or -1: what cross(dP/du, dP/dv) in camera space is to be multiplied by to point outwards.
  float normal_sign() const { return normal_sign_; }
  /// Largest factor by which world lengths grow in camera space.
  float camera_units_per_world_unit() const { return camera_scale_; }

 private:
  struct GeometryKey {
    size_t first = 0;
    double weight = 0;  ///< of key first + 1
  };
  const Geometry* geometry_;
  std::vector<float> times_;
  std::vector<glm::dmat4> matrices_;
  std::vector<GeometryKey> geometry_keys_;
  float normal_sign_ = 1, camera_scale_ = 1;
};

}  // namespace tessera
