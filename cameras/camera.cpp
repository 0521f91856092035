#include "cameras/camera.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "base/error.h"

namespace tessera {
namespace {

template <class T>
void require(bool good, const char* setting, T found, const char* expected) {
  if (!good) throw Error(fmt::format("camera: {} is {}; expected {}", setting, found, expected));
}

void check_raster(const CameraSettings& s) {
  require(s.x_resolution >= 1 && s.x_resolution <= 32768, "x resolution", s.x_resolution,
          "1 to 32768 pixels");
  require(s.y_resolution >= 1 && s.y_resolution <= 32768, "y resolution", s.y_resolution,
          "1 to 32768 pixels");
  require(s.pixel_aspect > 0 && std::isfinite(s.pixel_aspect), "pixel aspect ratio", s.pixel_aspect,
          "a positive number");
  if (s.frame_aspect)
    require(*s.frame_aspect > 0 && std::isfinite(*s.frame_aspect), "frame aspect ratio",
            *s.frame_aspect, "a positive number");
  if (s.screen_window) {
    const auto& w = *s.screen_window;
    require(w.left < w.right && std::isfinite(w.right - w.left), "screen window left",
            fmt::format("{} with right {}", w.left, w.right), "left < right");
    require(w.bottom < w.top && std::isfinite(w.top - w.bottom), "screen window bottom",
            fmt::format("{} with top {}", w.bottom, w.top), "bottom < top");
  }
  const auto& c = s.crop;
  require(0 <= c.x_min && c.x_min < c.x_max && c.x_max <= 1, "crop window in x",
          fmt::format("{} {}", c.x_min, c.x_max), "0 <= min < max <= 1");
  require(0 <= c.y_min && c.y_min < c.y_max && c.y_max <= 1, "crop window in y",
          fmt::format("{} {}", c.y_min, c.y_max), "0 <= min < max <= 1");
}

void check_optics(const CameraSettings& s) {
  if (s.projection == Projection::perspective)
    require(s.fov_degrees > 0 && s.fov_degrees < 180, "field of view", s.fov_degrees,
            "more than 0 and less than 180 degrees");
  require(s.near_clip >= 0 && s.near_clip < s.far_clip, "near clipping distance",
          fmt::format("{} with far {}", s.near_clip, s.far_clip), "0 <= near < far");
  if (s.lens) {
    require(s.lens->f_stop > 0, "f-stop", s.lens->f_stop, "a positive number");
    require(s.lens->focal_length > 0 && std::isfinite(s.lens->focal_length), "focal length",
            s.lens->focal_length, "a positive number");
    require(s.lens->focal_distance > 0, "focal distance", s.lens->focal_distance,
            "a positive number");
  }
  require(s.shutter_open <= s.shutter_close, "shutter opening time",
          fmt::format("{} with closing {}", s.shutter_open, s.shutter_close), "open <= close");
}

/// Size of the picture in pixels. A frame of another shape than the format is fitted into it, at
/// its top left, with whole pixels where the picture ends inside one (RenderMan Interface 3.2,
/// FrameAspectRatio and CropWindow).
glm::dvec2 picture_size(const CameraSettings& s) {
  const double format_aspect = s.x_resolution * s.pixel_aspect / s.y_resolution;
  const double aspect = s.frame_aspect.value_or(format_aspect);
  if (aspect >= format_aspect) return {s.x_resolution, s.y_resolution * format_aspect / aspect};
  return {s.x_resolution * aspect / format_aspect, s.y_resolution};
}

/// Pixels that `size` covers, at least one; a last sliver that is mere rounding does not count.
int whole_pixels(double size) { return std::max(1, int(std::ceil(size - 1e-6))); }

CameraSettings::ScreenWindow screen_window(const CameraSettings& s) {
  if (s.screen_window) return *s.screen_window;
  const double aspect = s.frame_aspect.value_or(s.x_resolution * s.pixel_aspect / s.y_resolution);
  if (aspect >= 1) return {-aspect, aspect, -1, 1};
  return {-1, 1, -1 / aspect, 1 / aspect};
}

PixelRect crop_pixels(const CameraSettings::CropWindow& crop, glm::dvec2 size, PixelRect frame) {
  const auto first = [](double fraction, double pixels) {
    return int(std::ceil(pixels * fraction));
  };
  const auto last = [](double fraction, double pixels) {
    return int(std::ceil(pixels * fraction - 1.0));
  };
  const PixelRect result = PixelRect{first(crop.x_min, size.x), first(crop.y_min, size.y),
                                     last(crop.x_max, size.x) + 1, last(crop.y_max, size.y) + 1}
                               .intersect(frame);
  if (result.empty())
    throw Error(fmt::format("camera: crop window {} {} {} {} holds no pixel of a {} x {} frame",
                            crop.x_min, crop.x_max, crop.y_min, crop.y_max, frame.width(),
                            frame.height()));
  return result;
}

float to_float(double value) {
  return float(std::min(value, double(std::numeric_limits<float>::max())));
}

}  // namespace

Camera::Camera(const CameraSettings& settings) : settings_(settings) {
  check_raster(settings_);
  check_optics(settings_);

  const glm::dvec2 size = picture_size(settings_);
  frame_ = {0, 0, whole_pixels(size.x), whole_pixels(size.y)};
  crop_ = crop_pixels(settings_.crop, size, frame_);
  near_ = to_float(settings_.near_clip);
  far_ = to_float(settings_.far_clip);

  // Screen space is camera space at W = 1, scaled so that fov spans [-1, 1].
  const CameraSettings::ScreenWindow window = screen_window(settings_);
  const double half_angle = settings_.fov_degrees * std::numbers::pi / 360.0;
  const double screen_scale = perspective() ? 1.0 / std::tan(half_angle) : 1.0;
  const double x_pixels = size.x / (window.right - window.left);
  const double y_pixels = size.y / (window.top - window.bottom);
  raster_scale_ = {x_pixels * screen_scale, -y_pixels * screen_scale};
  raster_centre_ = {-window.left * x_pixels, window.top * y_pixels};
  map_.x_scale = float(raster_scale_.x), map_.y_scale = float(raster_scale_.y);
  map_.x_from_w = float(raster_centre_.x), map_.y_from_w = float(raster_centre_.y);
  map_.w_from_z = perspective() ? 1.0f : 0.0f, map_.w_constant = perspective() ? 0.0f : 1.0f;
  require(std::isfinite(map_.x_scale) && std::isfinite(map_.y_scale) &&
              std::isfinite(map_.x_from_w) && std::isfinite(map_.y_from_w),
          "pixels per unit of the screen window", raster_scale_.x, "a number a float can hold");

  lens_profile_ = make_lens_profile(settings_.lens_profile, settings_.lens_blades,
                                    settings_.lens_rotation_degrees);
  shutter_profile_ = make_shutter_profile(settings_.shutter_profile);
  if (settings_.lens) set_lens(*settings_.lens);
}

void Camera::set_lens(const CameraSettings::ThinLens& lens) {
  lens_radius_ = lens.focal_length / (2.0 * lens.f_stop);
  lens_open_ = lens_radius_ > 0.0;  // an infinite f-stop is a pinhole
  // A point at depth z seen from lens offset L appears in the plane of focus, at depth f, where the
  // line from the point through L meets it. Projected and multiplied by z, that is the position
  // seen through the centre plus L (z / f - 1). Lens v points down, as raster y does.
  const double x = raster_scale_.x * lens_radius_, y = -raster_scale_.y * lens_radius_;
  map_.coc_x = {float(x / lens.focal_distance), float(-x)};
  map_.coc_y = {float(y / lens.focal_distance), float(-y)};
  require(std::isfinite(map_.coc_x.scale) && std::isfinite(map_.coc_x.offset) &&
              std::isfinite(map_.coc_y.scale) && std::isfinite(map_.coc_y.offset),
          "lens radius in pixels", x, "a number a float can hold");
}

glm::vec3 Camera::raster_clip_from_camera(const glm::vec3& P_camera) const {
  const float w = map_.w_from_z * P_camera.z + map_.w_constant;
  return {map_.x_scale * P_camera.x + map_.x_from_w * w,
          map_.y_scale * P_camera.y + map_.y_from_w * w, w};
}

glm::vec2 Camera::coc_raster(float z) const {
  const float w = map_.w_from_z * z + map_.w_constant;
  return {map_.coc_x(z) / w, map_.coc_y(z) / w};
}

Camera::Ray Camera::ray_camera(glm::dvec2 pixel, glm::dvec2 lens) const {
  const glm::dvec2 screen = (pixel - raster_centre_) / raster_scale_;  // camera units at W = 1
  const glm::dvec2 offset = lens_radius_ * glm::dvec2(lens.x, -lens.y);
  const glm::dvec2 slope = lens_open_ ? -offset / settings_.lens->focal_distance : glm::dvec2(0.0);
  if (perspective()) return {{offset, 0.0}, {screen + slope, 1.0}};
  return {{screen + offset, 0.0}, {slope, 1.0}};
}

}  // namespace tessera
