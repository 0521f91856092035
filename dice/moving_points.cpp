#include "dice/moving_points.h"

#include <algorithm>
#include <cmath>

namespace tessera {

namespace {

std::vector<float> union_of_keys(const Surface& surface, const Camera& camera) {
  const std::vector<float> object =
      merged_key_times(surface.geometry->key_times, surface.world_from_object.times());
  std::vector<float> times = merged_key_times(object, camera.settings().camera_from_world.times());
  if (times.size() < 2) return {0.0f};
  if (times.front() > 0) times.insert(times.begin(), 0.0f);
  if (times.back() < 1) times.push_back(1.0f);
  return times;
}

// Upper bound of the operator norm that is exact for scaled rotations: |A|^2 <= |A^T A|_inf.
float operator_norm(const glm::dmat3& a) {
  const glm::dmat3 square = glm::transpose(a) * a;
  double most = 0;
  for (int i = 0; i < 3; ++i) {
    most = std::max(most, std::abs(square[i][0]) + std::abs(square[i][1]) + std::abs(square[i][2]));
  }
  return float(std::sqrt(most));
}

}  // namespace

MovingPoints::MovingPoints(const Surface& surface, const Camera& camera)
    : geometry_(surface.geometry.get()), times_(union_of_keys(surface, camera)) {
  camera_scale_ = 0;
  const std::vector<float>& keys = geometry_->key_times;
  for (float t : times_) {
    const glm::dmat4 camera_from_world = camera.camera_from_world(t);
    camera_scale_ = std::max(camera_scale_, operator_norm(glm::dmat3(camera_from_world)));
    matrices_.push_back(camera_from_world * surface.world_from_object.at(t));
    GeometryKey key;
    while (key.first + 1 < keys.size() && keys[key.first + 1] <= t) ++key.first;
    if (key.first + 1 < keys.size() && t > keys[key.first]) {
      key.weight = double(t - keys[key.first]) / double(keys[key.first + 1] - keys[key.first]);
    }
    geometry_keys_.push_back(key);
  }
  // A cross product maps to the determinant's sign times itself, up to a positive-definite map.
  const bool mirrored = glm::determinant(glm::dmat3(camera.camera_from_world(0))) < 0;
  normal_sign_ = surface.flip_normal == mirrored ? 1.0f : -1.0f;
}

glm::dvec3 MovingPoints::point_object(int key, int vertex) const {
  const GeometryKey& at = geometry_keys_[size_t(key)];
  const glm::dvec3 a(geometry_->P_object[at.first][size_t(vertex)]);
  if (at.weight == 0) return a;
  const glm::dvec3 b(geometry_->P_object[at.first + 1][size_t(vertex)]);
  return a + (b - a) * at.weight;
}

glm::vec3 MovingPoints::point(int key, int vertex) const {
  return glm::vec3(matrices_[size_t(key)] * glm::dvec4(point_object(key, vertex), 1.0));
}

}  // namespace tessera
