#pragma once
/// What of a scene moves while the shutter is open.

#include <algorithm>

#include "scenes/scene.h"

namespace tessera {

inline bool shutter_opens(const CameraSettings& camera) {
  return camera.shutter_close > camera.shutter_open;
}

/// Whether the surface has motion keys, if the shutter opens.
inline bool surface_moves(const Surface& surface) {
  return surface.world_from_object.moves() || surface.geometry->key_times.size() > 1;
}

/// Whether any surface moves in the world while the shutter is open.
inline bool surfaces_move(const Scene& scene) {
  return shutter_opens(scene.camera) && std::ranges::any_of(scene.surfaces, surface_moves);
}

}  // namespace tessera
