#include "dice/least_blur.h"

#include <algorithm>
#include <cmath>

namespace tessera {

namespace {

/// A length that none of the vectors from[i] -> to[i], nor any vector of their convex hull, falls
/// short of: the least one along the direction of their sum.
float least_displacement(const glm::vec2* from, const glm::vec2* to, size_t count) {
  glm::dvec2 sum(0);
  for (size_t i = 0; i < count; ++i) sum += glm::dvec2(to[i] - from[i]);
  const double length = glm::length(sum);
  if (!(length > 0) || !std::isfinite(length)) return 0;
  const glm::vec2 direction(sum / length);
  float least = std::numeric_limits<float>::infinity();
  for (size_t i = 0; i < count; ++i) least = std::min(least, glm::dot(to[i] - from[i], direction));
  return std::max(least, 0.0f);
}

}  // namespace

void LeastBlur::add_key(const RasterProjection& projection, float t,
                        std::span<const glm::vec3> P_camera) {
  const RasterClipMap& map = projection.map();
  std::array<glm::vec2, most_samples> raster;
  const size_t count = std::min(P_camera.size(), most_samples);
  for (size_t i = 0; i < count; ++i) {
    const glm::vec3& p = P_camera[i];
    const float w = map.w_from_z * p.z + map.w_constant;
    if (!(w > 0) || !(p.z > projection.near_clip())) known_ = false;
    raster[i] = {map.x_scale * p.x / w, map.y_scale * p.y / w};
    const float coc = projection.lens_extent() * map.coc_y(p.z) / w;
    const bool is_first = keys_ == 0 && i == 0;
    least_coc_ = is_first ? coc : std::min(least_coc_, coc);
    most_coc_ = is_first ? coc : std::max(most_coc_, coc);
  }
  if (keys_ == 0) {
    std::copy_n(raster.begin(), count, first_.begin());
  } else {
    const float speed =
        least_displacement(previous_.data(), raster.data(), count) / (t - previous_t_);
    slowest_ = keys_ == 1 ? speed : std::min(slowest_, speed);
    farthest_ = std::max(farthest_, least_displacement(first_.data(), raster.data(), count));
  }
  std::copy_n(raster.begin(), count, previous_.begin());
  previous_t_ = t;
  ++keys_;
}

float LeastBlur::motion_pixels() const {
  const float pixels = std::min(slowest_, farthest_);
  return known_ && std::isfinite(pixels) ? pixels : 0.0f;
}

float LeastBlur::focus_pixels() const {
  // Of both signs: some point is in focus at some time.
  const float radius = std::max({least_coc_, -most_coc_, 0.0f});
  return known_ && std::isfinite(radius) ? 2 * radius : 0.0f;
}

}  // namespace tessera
