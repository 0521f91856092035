#pragma once
/// Random buckets, ordinary and extreme.

#include "tests/hide/hide_fixture.h"

namespace tessera {

struct RandomOptions {
  bool motion = false, lens = false, orthographic = false;
  int keys = 2;
  float reach = 4;  ///< of the grids' centres across, camera units
  float depth_min = 2, depth_max = 8;
  float speed = 0.5f;      ///< camera units per shutter
  float roughness = 0.2f;  ///< of the vertices, in micropolygon sizes
  float grid_size = 1.5f;  ///< camera units
};

inline std::unique_ptr<Grid> random_grid(std::mt19937& random, const RandomOptions& o) {
  std::uniform_real_distribution<float> unit(-1, 1);
  std::uniform_int_distribution<int> count(1, 9);
  const auto vector = [&](float size) {
    return size * glm::vec3(unit(random), unit(random), unit(random));
  };
  const int u_count = count(random), v_count = count(random);
  glm::vec3 centre = vector(o.reach);
  centre.z = o.depth_min + (o.depth_max - o.depth_min) * 0.5f * (1 + unit(random));
  const glm::vec3 along_u = vector(o.grid_size), along_v = vector(o.grid_size);
  std::vector<float> times{0.0f};
  const int keys = o.motion && unit(random) > -0.8f ? o.keys : 1;
  if (keys > 1)
    for (int k = 1; k < keys; ++k) times.push_back(float(k * k) / float((keys - 1) * (keys - 1)));
  std::vector<glm::vec3> shift(size_t(keys), glm::vec3(0.0f));
  for (size_t k = 1; k < shift.size(); ++k) shift[k] = vector(o.speed);
  const float cell = o.roughness * o.grid_size / float(std::max(u_count, v_count));
  return make_grid(u_count, v_count, times, [&](float u, float v, int key) {
    return centre + shift[size_t(key)] + along_u * (u - 0.5f) + along_v * (v - 0.5f) + vector(cell);
  });
}

inline TestBucket random_bucket(uint32_t seed, const RandomOptions& o, const PixelRect& rect,
                                int samples_per_pixel, int grid_count) {
  std::mt19937 random(seed);
  CameraSettings settings = perspective_settings(64, 48);
  if (o.orthographic) {
    settings.projection = Projection::orthographic;
    settings.screen_window = {{-4.0, 4.0, -3.0, 3.0}};
  }
  if (o.lens) settings.lens = CameraSettings::ThinLens{2.0, 1.0, 4.5};
  TestBucket bucket(settings);
  for (int g = 0; g < grid_count; ++g) bucket.add(random_grid(random, o));
  bucket.motion = o.motion;
  bucket.make_samples(rect, samples_per_pixel, seed);
  return bucket;
}

}  // namespace tessera
