#pragma once
/// The scene as the settings want it.

#include <memory>

#include "engine/settings.h"
#include "scenes/scene.h"

namespace tessera {

/// A scene with the settings that change the scene itself (crop, resolution, shading rate, factors
/// of GeometricApproximation) applied. Shares all geometry with `scene`; when nothing changes but
/// the camera, attributes are shared too. Throws Error when a rate or factor is out of range.
Scene apply_overrides(const Scene& scene, const Settings& settings);

}  // namespace tessera
