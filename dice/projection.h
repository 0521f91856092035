#pragma once
/// Sizes and bounds on the raster, over the shutter and the lens.

#include <array>
#include <span>

#include "cameras/camera.h"

namespace tessera {

/// Everything dicing needs to know of a camera, for one frame.
class RasterProjection {
 public:
  RasterProjection(const Camera& camera, const PixelRect& crop);

  /// Upper estimate in pixels of the raster length of the camera-space segment from a to b, from
  /// any point of the lens, as far as the frame shows it: an end beside the frame counts where it
  /// would enter it. So the estimate is bounded where a segment nears or crosses the camera plane;
  /// behind it, it is zero. Of the frame, not the crop: a crop is diced like the whole.
  ///
  /// After turn_to_eye() instead: half the length that the segment would have in the middle of the
  /// frame, squarely and at its own distance from the eye, or, if both ends are in the frame and it
  /// looks longer, what it looks like.
  ///
  /// `frames`: as if the frame were that many times as wide and as high, about the optical axis.
  float segment_length(const glm::vec3& a, const glm::vec3& b, float frames = 1) const;

  /// Signed distances, each in a unit of its own, from the frame's four sides and its near plane,
  /// linear in P_camera; negative beyond a side for every point of the lens. A segment of which
  /// both ends are beyond one side is not in the frame.
  static constexpr size_t side_count = 5;
  std::array<double, side_count> inside(const glm::vec3& P_camera) const;

  /// Makes segment_length() measure what is out of sight, too. What is nearer than
  /// `least_distance` (camera units, positive) counts as if it were at that distance.
  void turn_to_eye(float least_distance) { least_distance_ = least_distance; }
  bool turned_to_eye() const { return least_distance_ > 0; }

  /// Whether nothing in the convex hull of `points`, grown by `radius` (camera units), can be seen
  /// in the crop rectangle by any lens coordinate. Separating planes through the eye: needs no
  /// divide by W, so the hull may contain points behind the camera. Points at several motion keys
  /// may be given together, for they move linearly in between.
  bool outside_crop(std::span<const glm::vec3> points, float radius) const;

  /// Raster box of the convex hull of `points` grown by `radius`, through the whole lens;
  /// everything() when it reaches the camera plane. `z_min` receives the least camera depth.
  RasterBounds bounds(std::span<const glm::vec3> points, float radius, float& z_min) const;

  const RasterClipMap& map() const { return map_; }
  /// Largest |u| or |v| on the lens; 0 for a pinhole.
  float lens_extent() const { return lens_extent_; }
  float near_clip() const { return near_; }
  bool perspective() const { return perspective_; }

 private:
  /// The least W, at least `w` and the near plane, at which a point with this x and y could be in
  /// `frames` frames from some point of the lens.
  float visible_w(const glm::vec3& P_camera, float w, float frames) const;

  bool in_frame(const glm::vec3& P_camera, float frames) const;
  float seen_length(const glm::vec3& a, const glm::vec3& b, float frames) const;
  float turned_length(const glm::vec3& a, const glm::vec3& b) const;

  /// Adds one camera-space point through the whole lens; returns false (and adds nothing) when it
  /// is not in front of the camera plane.
  bool add_point(const glm::vec3& P_camera, RasterBounds& box) const;

  RasterClipMap map_;
  PixelRect crop_;
  float lens_extent_ = 0;
  float near_ = 0, far_ = 0;
  float pixels_per_unit_ = 1;
  float reach_x_ = 1, reach_y_ = 1;  ///< pixels from the optical axis to the frame's far side
  float least_distance_ = 0;         ///< 0: lengths as the frame shows them
  bool perspective_ = true;
};

}  // namespace tessera
