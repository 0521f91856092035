#pragma once
/// What the extreme cases (tests/hide/extreme_cases.h) are made of.

#include <array>
#include <cmath>
#include <vector>

#include "tests/hide/random_scenes.h"

namespace tessera {

/// Corners a, b, c, d of a micropolygon (dice/grid.h) at each key.
using QuadKeys = std::vector<std::array<glm::vec3, 4>>;

inline std::vector<float> even_times(size_t keys) {
  std::vector<float> times{0.0f};
  for (size_t k = 1; k < keys; ++k) times.push_back(float(k) / float(keys - 1));
  return times;
}

inline void add_quad(TestBucket& bucket, const QuadKeys& keys, std::vector<float> times = {}) {
  if (times.empty()) times = even_times(keys.size());
  bucket.add(make_grid(1, 1, times, [&](float u, float v, int key) {
    return keys[size_t(key)][size_t(v > 0.5f) * 2 + size_t(u > 0.5f)];
  }));
}

/// Numbers for one variant, the same on every run.
class ExtremeRandom {
 public:
  explicit ExtremeRandom(int seed) : random_(uint32_t(seed)) {}
  float between(float low, float high) {
    return std::uniform_real_distribution<float>(low, high)(random_);
  }
  float log_between(float low, float high) {
    return std::exp(between(std::log(low), std::log(high)));
  }
  glm::vec3 in_box(glm::vec3 middle, glm::vec3 half) {
    const float x = between(-1, 1), y = between(-1, 1), z = between(-1, 1);
    return middle + half * glm::vec3(x, y, z);
  }
  std::mt19937& generator() { return random_; }

 private:
  std::mt19937 random_;
};

/// A square in the plane z, a little uneven.
inline std::array<glm::vec3, 4> square(ExtremeRandom& random, float half, float z) {
  const glm::vec3 jitter(0.2f * half);
  return {random.in_box({-half, -half, z}, jitter), random.in_box({half, -half, z}, jitter),
          random.in_box({-half, half, z}, jitter), random.in_box({half, half, z}, jitter)};
}

inline CameraSettings extreme_settings(double fov_degrees = 60) {
  return perspective_settings(32, 24, fov_degrees);
}

inline void open_lens(CameraSettings& settings, double radius, double focal_distance) {
  settings.lens =
      CameraSettings::ThinLens{0.5, radius, focal_distance};  // radius = focal / 2 stops
}

/// The middle of extreme_settings(), 4 samples a pixel.
inline TestBucket sampled(TestBucket bucket, int seed, const PixelRect& rect = {12, 8, 20, 16}) {
  bucket.make_samples(rect, 4, uint32_t(seed));
  return bucket;
}

}  // namespace tessera
