#pragma once
/// The options part of the graphics state.

#include "scenes/scene_calls.h"
#include "scenes/scene_time.h"

#include "base/diagnostics.h"

namespace tessera {

/// Options in force; copied when a frame or world begins.
///
/// Beyond the RenderMan Interface:
///   Option "camera" "string shutterprofile" ["box"|"trapezoid"|"gaussian"]
///                   "string lensprofile" ["disc"|"smooth"|"polygon"]
///                   "int lensblades" [n] "float lensrotation" [degrees]
struct OptionState {
  CameraSettings camera;  ///< camera_from_world is set by the builder
  bool projection_given = false;
  SceneOptions options;
  std::vector<Display> displays;

  ShutterInterval shutter() const { return {camera.shutter_open, camera.shutter_close}; }

  /// Throws Error at `where` when a value is out of its range.
  void apply(const OptionCall& call, const SourceLocation& where, Diagnostics& diagnostics);
};

}  // namespace tessera
