#include "dice/projection.h"

#include <algorithm>
#include <cmath>

namespace tessera {

namespace {

/// What is foreshortened or out of sight shows in shadows and reflected light only.
constexpr double least_part = 0.5;

}  // namespace

RasterProjection::RasterProjection(const Camera& camera, const PixelRect& crop)
    : map_(camera.raster_clip()),
      crop_(crop),
      lens_extent_(camera.lens_open() ? camera.lens_profile().extent() : 0.0f),
      near_(camera.near_clip()),
      far_(camera.far_clip()),
      pixels_per_unit_(std::max(std::abs(map_.x_scale), std::abs(map_.y_scale))),
      perspective_(map_.w_from_z != 0) {
  const PixelRect frame = camera.frame();
  const auto farthest = [](float axis, int low, int high) {
    return std::max({std::abs(float(low) - axis), std::abs(float(high) - axis), 1.0f});
  };
  reach_x_ = farthest(map_.x_from_w, frame.x0, frame.x1);
  reach_y_ = farthest(map_.y_from_w, frame.y0, frame.y1);
}

float RasterProjection::visible_w(const glm::vec3& P_camera, float w, float frames) const {
  const auto entry = [&](float lateral, float reach, const AffineInZ& coc) {
    return (std::abs(lateral) - lens_extent_ * std::abs(coc.offset)) /
           (frames * reach + lens_extent_ * std::abs(coc.scale));
  };
  const float w_x = entry(map_.x_scale * P_camera.x, reach_x_, map_.coc_x);
  const float w_y = entry(map_.y_scale * P_camera.y, reach_y_, map_.coc_y);
  return std::max({w, w_x, w_y, std::max(near_, 1e-20f)});
}

std::array<double, RasterProjection::side_count> RasterProjection::inside(
    const glm::vec3& P_camera) const {
  // visible_w() <= w, multiplied out.
  const double w = double(map_.w_from_z) * P_camera.z + map_.w_constant, lens = lens_extent_;
  const auto half_width = [&](double reach, const AffineInZ& coc) {
    return (reach + lens * std::abs(coc.scale)) * w + lens * std::abs(coc.offset);
  };
  const double x = double(map_.x_scale) * P_camera.x, y = double(map_.y_scale) * P_camera.y;
  const double half_x = half_width(reach_x_, map_.coc_x), half_y = half_width(reach_y_, map_.coc_y);
  return {half_x + x, half_x - x, half_y + y, half_y - y, w - std::max(near_, 1e-20f)};
}

bool RasterProjection::in_frame(const glm::vec3& P_camera, float frames) const {
  const float w = map_.w_from_z * P_camera.z + map_.w_constant;
  return w > 0 && visible_w(P_camera, w, frames) <= std::max(w, near_);
}

float RasterProjection::turned_length(const glm::vec3& a, const glm::vec3& b) const {
  // In double: squares of large or small coordinates leave the range of float.
  const glm::dvec3 from(a), to(b);
  double distance = 1;
  if (perspective_) {
    const double nearest =
        std::min({glm::length(from), glm::length(to), glm::length(0.5 * (from + to))});
    distance = std::max(nearest, double(least_distance_));
  }
  const double length = least_part * pixels_per_unit_ * glm::length(to - from) / distance;
  return std::isfinite(length) ? float(std::min(length, 1e9)) : 0.0f;
}

float RasterProjection::segment_length(const glm::vec3& a, const glm::vec3& b, float frames) const {
  if (!(least_distance_ > 0)) return seen_length(a, b, frames);
  const float turned = turned_length(a, b);
  const bool both_in = in_frame(a, frames) && in_frame(b, frames);
  return both_in ? std::max(turned, seen_length(a, b, frames)) : turned;
}

float RasterProjection::seen_length(const glm::vec3& a, const glm::vec3& b, float frames) const {
  float w_a = map_.w_from_z * a.z + map_.w_constant;
  float w_b = map_.w_from_z * b.z + map_.w_constant;
  if (w_a <= 0 && w_b <= 0) return 0;
  float most = std::numeric_limits<float>::max();
  if (perspective_) {
    w_a = visible_w(a, w_a, frames), w_b = visible_w(b, w_b, frames);
    // A segment as long as its distance from the camera plane spans about pixels_per_unit; what
    // passes through the lens itself is given a few times that.
    most = 4 * pixels_per_unit_;
  }
  const float dx = map_.x_scale * (a.x / w_a - b.x / w_b);
  const float dy = map_.y_scale * (a.y / w_a - b.y / w_b);
  float length = std::sqrt(dx * dx + dy * dy);
  if (lens_extent_ > 0) {
    length += lens_extent_ * std::abs(map_.coc_y(a.z) / w_a - map_.coc_y(b.z) / w_b);
  }
  if (std::isnan(length)) return 0;
  return length < most ? length : most;
}

bool RasterProjection::outside_crop(std::span<const glm::vec3> points, float radius) const {
  bool left = true, right = true, above = true, below = true, before = true, beyond = true;
  // How far a displacement of `radius` can carry each plane's value.
  const auto slack = [&](float scale, float offset, const AffineInZ& coc) {
    return radius * (std::abs(scale) + std::abs(offset * map_.w_from_z) +
                     lens_extent_ * std::abs(coc.scale));
  };
  const float x0 = float(crop_.x0), x1 = float(crop_.x1);
  const float y0 = float(crop_.y0), y1 = float(crop_.y1);
  const float slack_x0 = slack(map_.x_scale, map_.x_from_w - x0, map_.coc_x);
  const float slack_x1 = slack(map_.x_scale, map_.x_from_w - x1, map_.coc_x);
  const float slack_y0 = slack(map_.y_scale, map_.y_from_w - y0, map_.coc_y);
  const float slack_y1 = slack(map_.y_scale, map_.y_from_w - y1, map_.coc_y);
  for (const glm::vec3& p : points) {
    const float w = map_.w_from_z * p.z + map_.w_constant;
    const float x = map_.x_scale * p.x, y = map_.y_scale * p.y;
    const float blur_x = lens_extent_ * std::abs(map_.coc_x(p.z));
    const float blur_y = lens_extent_ * std::abs(map_.coc_y(p.z));
    // Float rounding, relative to the terms that are added up.
    const float ulp = 4e-6f * (std::abs(x) + std::abs(w) * (std::abs(map_.x_from_w) + x1) + blur_x);
    const float vlp = 4e-6f * (std::abs(y) + std::abs(w) * (std::abs(map_.y_from_w) + y1) + blur_y);
    left &= x + (map_.x_from_w - x0) * w + blur_x + slack_x0 + ulp < 0;
    right &= x + (map_.x_from_w - x1) * w - blur_x - slack_x1 - ulp > 0;
    above &= y + (map_.y_from_w - y0) * w + blur_y + slack_y0 + vlp < 0;
    below &= y + (map_.y_from_w - y1) * w - blur_y - slack_y1 - vlp > 0;
    before &= p.z + radius < near_;
    beyond &= p.z - radius > far_;
  }
  return left || right || above || below || before || beyond;
}

bool RasterProjection::add_point(const glm::vec3& P_camera, RasterBounds& box) const {
  const float w = map_.w_from_z * P_camera.z + map_.w_constant;
  if (!(w > 0)) return false;
  const float x = map_.x_scale * P_camera.x + map_.x_from_w * w;
  const float y = map_.y_scale * P_camera.y + map_.y_from_w * w;
  const float blur_x = lens_extent_ * std::abs(map_.coc_x(P_camera.z));
  const float blur_y = lens_extent_ * std::abs(map_.coc_y(P_camera.z));
  box.add((x - blur_x) / w, (y - blur_y) / w);
  box.add((x + blur_x) / w, (y + blur_y) / w);
  return true;
}

RasterBounds RasterProjection::bounds(std::span<const glm::vec3> points, float radius,
                                      float& z_min) const {
  RasterBounds box;
  z_min = std::numeric_limits<float>::infinity();
  bool in_front = true;
  const auto add = [&](const glm::vec3& p) {
    z_min = std::min(z_min, p.z);
    in_front = in_front && add_point(p, box);
  };
  if (radius > 0) {
    glm::vec3 low(std::numeric_limits<float>::infinity()), high = -low;
    for (const glm::vec3& p : points) low = glm::min(low, p), high = glm::max(high, p);
    low -= radius;
    high += radius;
    for (int corner = 0; corner < 8; ++corner) {
      add({corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y, corner & 4 ? high.z : low.z});
    }
  } else {
    for (const glm::vec3& p : points) add(p);
  }
  // Also false when a coordinate is not a number.
  const bool bounded = in_front && box.x_max - box.x_min < 1e9f && box.y_max - box.y_min < 1e9f;
  if (!bounded) return RasterBounds::everything();
  // Vertices are evaluated in float arithmetic by other formulas than the hull's.
  const float pad_x = 0.01f + 1e-5f * std::max(std::abs(box.x_min), std::abs(box.x_max));
  const float pad_y = 0.01f + 1e-5f * std::max(std::abs(box.y_min), std::abs(box.y_max));
  return {box.x_min - pad_x, box.y_min - pad_y, box.x_max + pad_x, box.y_max + pad_y};
}

}  // namespace tessera
