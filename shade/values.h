#pragma once
/// The array types that shaders read and write: structure-of-arrays, one entry a point.

#include <cstddef>

#include <glm/glm.hpp>

#include "base/aligned.h"

namespace tessera {

/// A scalar that is the same at every point (step 0) or differs from point to point (step 1).
struct ScalarInput {
  const float* values = nullptr;
  int step = 0;
  float operator[](int i) const { return values[i * step]; }
};

/// Three floats, the same at every point (step 0) or varying (step 1).
struct Vec3Input {
  const float *x = nullptr, *y = nullptr, *z = nullptr;
  int step = 0;
  glm::vec3 operator[](int i) const { return {x[i * step], y[i * step], z[i * step]}; }

  /// Varying values stored as three runs of `stride` floats.
  static Vec3Input varying(const float* run, size_t stride) {
    return {run, run + stride, run + 2 * stride, 1};
  }
  static Vec3Input uniform(const float* xyz) { return {xyz, xyz + 1, xyz + 2, 0}; }
};

/// Owned varying values, three padded runs; zero to begin with.
class Vec3Array {
 public:
  Vec3Array() = default;
  explicit Vec3Array(int count) { reset(count); }
  /// Holds `count` zeros.
  void reset(int count) {
    count_ = count;
    stride_ = padded(size_t(count));
    values_.assign(3 * stride_, 0.0f);
  }
  int count() const { return count_; }
  float* component(int c) { return values_.data() + size_t(c) * stride_; }
  const float* component(int c) const { return values_.data() + size_t(c) * stride_; }
  glm::vec3 operator[](int i) const {
    const float* v = values_.data() + i;
    return {v[0], v[stride_], v[2 * stride_]};
  }
  void set(int i, const glm::vec3& value) {
    float* v = values_.data() + i;
    v[0] = value.x, v[stride_] = value.y, v[2 * stride_] = value.z;
  }
  void add(int i, const glm::vec3& value) { set(i, (*this)[i] + value); }
  operator Vec3Input() const { return Vec3Input::varying(values_.data(), stride_); }

 private:
  int count_ = 0;
  size_t stride_ = 0;
  AlignedVector<float> values_;
};

}  // namespace tessera
