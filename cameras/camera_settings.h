#pragma once
/// What a scene says about its camera, in the units of the scene file, converted to nothing yet.

#include <optional>
#include <string>

#include "base/transform.h"

namespace tessera {

enum class Projection { perspective, orthographic };

struct CameraSettings {
  Projection projection = Projection::orthographic;
  double fov_degrees = 90.0;  ///< full angle over the shorter side of a [-1, 1] screen window
  MovingTransform camera_from_world;  ///< camera space: left-handed, x right, y up, z into the scene

  int x_resolution = 640, y_resolution = 480;  ///< pixels
  double pixel_aspect = 1.0;                   ///< width over height of a pixel
  std::optional<double> frame_aspect;          ///< FrameAspectRatio, if given
  struct ScreenWindow {
    double left, right, bottom, top;
  };
  std::optional<ScreenWindow> screen_window;  ///< default: from the frame aspect, shorter side [-1, 1]
  struct CropWindow {
    double x_min = 0, x_max = 1, y_min = 0, y_max = 1;
  };
  CropWindow crop;  ///< fractions of the raster, y down

  double near_clip = 1e-10, far_clip = 1e30;  ///< camera z

  struct ThinLens {
    double f_stop, focal_length, focal_distance;  ///< focal lengths in camera units
  };
  std::optional<ThinLens> lens;  ///< absent: pinhole

  double shutter_open = 0.0, shutter_close = 0.0;  ///< scene time units
  std::string shutter_profile = "box";             ///< box, trapezoid, gaussian
  std::string lens_profile = "disc";               ///< disc, smooth, polygon
  int lens_blades = 6;                             ///< for the polygon profile
  double lens_rotation_degrees = 0.0;
};

}  // namespace tessera
