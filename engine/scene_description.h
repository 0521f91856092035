#pragma once
/// What a scene holds, for people.

#include <string>

#include "scenes/scene.h"

namespace tessera {

/// Lines "name  value": frame, camera, surfaces with their shapes by kind, lights, shaders,
/// options, displays.
std::string describe_scene(const Scene& scene);

}  // namespace tessera
