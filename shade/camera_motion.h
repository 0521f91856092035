#pragma once
/// Lights stand still in the world while their positions are bound in camera space at shutter open.
/// Points that samples see, and what rays meet, are in camera space at their own time.

#include "cameras/camera.h"
#include "shade/points.h"

namespace tessera {

class CameraMotion {
 public:
  /// `camera` may be null: one that stands still.
  explicit CameraMotion(const Camera* camera) {
    if (!camera || !camera->settings().camera_from_world.moves()) return;
    camera_ = camera;
    world_from_open_ = glm::inverse(camera->camera_from_world(0.0f));
  }

  /// Whether camera space at the times of these points may differ from that at shutter open.
  bool concerns(const ShadingPoints& points) const { return camera_ && points.time; }
  /// Camera space at shutter time `time` from camera space at shutter open. Only of what concerns.
  glm::dmat4 now_from_open(float time) const {
    return camera_->camera_from_world(time) * world_from_open_;
  }

 private:
  const Camera* camera_ = nullptr;
  glm::dmat4 world_from_open_{1.0};
};

}  // namespace tessera
