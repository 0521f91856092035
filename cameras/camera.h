#pragma once
/// Stage header: cameras. Takes CameraSettings; gives the maps from world to raster, the circle of
/// confusion, and the lens and shutter profiles. Knows nothing of scenes.
///
/// The hider works in *raster clip* coordinates, homogeneous raster coordinates before the divide:
/// a camera-space point maps to (X, Y, W) and is seen at raster position (X / W, Y / W). Thin-lens
/// blur moves it to (X + u * coc_x(z), Y + v * coc_y(z), W) for lens coordinates (u, v), so nothing
/// ever divides by W before the inside test. For an orthographic camera W is 1.

#include <memory>

#include <glm/glm.hpp>

#include "base/raster.h"
#include "cameras/camera_settings.h"
#include "cameras/lens_profile.h"
#include "cameras/shutter_profile.h"

namespace tessera {

/// An affine function of camera depth z: scale * z + offset.
struct AffineInZ {
  float scale = 0.0f, offset = 0.0f;
  float operator()(float z) const { return scale * z + offset; }
};

/// The affine map from camera space to raster clip space. Exact in float for every vertex, so that
/// two grids that share a camera-space vertex share its raster clip position bit for bit:
///   X = x_scale * x + x_from_w * W,  Y = y_scale * y + y_from_w * W,  W = w_from_z * z +
///   w_constant.
struct RasterClipMap {
  float x_scale = 1,
        y_scale = 1;  ///< pixels per camera unit at W = 1; y_scale is negative (y down)
  float x_from_w = 0, y_from_w = 0;    ///< raster position of the optical axis, pixels
  float w_from_z = 1, w_constant = 0;  ///< (1, 0) perspective, (0, 1) orthographic
  AffineInZ coc_x, coc_y;  ///< raster clip shift per unit lens coordinate; zero for a pinhole
};

class Camera {
 public:
  /// Throws Error when a setting is out of range (field of view outside (0, 180), empty crop, ...),
  /// naming the setting and the range.
  explicit Camera(const CameraSettings& settings);

  const CameraSettings& settings() const { return settings_; }
  glm::dmat4 camera_from_world(float t) const { return settings_.camera_from_world.at(t); }
  bool perspective() const { return settings_.projection == Projection::perspective; }
  bool lens_open() const { return lens_open_; }

  const RasterClipMap& raster_clip() const { return map_; }
  /// (X, Y, W) of a camera-space point seen through the lens centre.
  glm::vec3 raster_clip_from_camera(const glm::vec3& P_camera) const;
  /// Signed raster radii of the circle of confusion at depth z (x and y), pixels per unit lens
  /// coordinate: coc / W.
  glm::vec2 coc_raster(float z) const;

  /// Camera-space ray through raster position `pixel` and lens coordinates `lens`: the points
  /// origin + s * direction with s = camera z for a perspective camera. For oracles and ray
  /// tracers.
  struct Ray {
    glm::dvec3 origin, direction;
  };
  Ray ray_camera(glm::dvec2 pixel, glm::dvec2 lens) const;

  /// Pixels of the whole picture: the format, or the part of it (from its top left) that a picture
  /// of another FrameAspectRatio takes up.
  PixelRect frame() const { return frame_; }
  /// Pixels to render: frame cut by the crop window, rounded as the RenderMan interface prescribes.
  PixelRect crop() const { return crop_; }
  float near_clip() const { return near_; }
  float far_clip() const { return far_; }

  const LensProfile& lens_profile() const { return *lens_profile_; }
  const ShutterProfile& shutter_profile() const { return *shutter_profile_; }

 private:
  void set_lens(const CameraSettings::ThinLens& lens);

  CameraSettings settings_;
  RasterClipMap map_;
  glm::dvec2 raster_scale_{1.0};   ///< pixels per camera unit at W = 1, before rounding to float
  glm::dvec2 raster_centre_{0.0};  ///< raster position of the optical axis, before rounding
  PixelRect frame_, crop_;
  float near_ = 0, far_ = 0;
  bool lens_open_ = false;
  double lens_radius_ = 0;
  std::shared_ptr<const LensProfile> lens_profile_;
  std::shared_ptr<const ShutterProfile> shutter_profile_;
};

}  // namespace tessera
