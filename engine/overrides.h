#pragma once
/// The scene as the settings want it.

#include <memory>

#include "engine/settings.h"
#include "scenes/scene.h"

namespace tessera {

/// A scene with the settings that change the scene itself (crop, resolution, shading rate) applied.
/// Shares all geometry with `scene`; when nothing changes but the camera, attributes are shared too.
Scene apply_overrides(const Scene& scene, const Settings& settings);

}  // namespace tessera
