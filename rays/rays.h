#pragma once
/// Ray tracing for shaders: a dice of the whole scene, coarser than the one that is seen, under
/// Embree. Embree lives in a module, tessera_embree.so, that is loaded when a frame needs rays.

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "base/diagnostics.h"
#include "cameras/camera.h"
#include "dice/dice.h"
#include "shade/ray_tracer.h"

namespace tessera {

struct RaySettings {
  int max_grid_size = 32;                ///< micropolygons along u and v
  std::optional<float> dicing_rate;      ///< area of a micropolygon, pixels^2, for every surface;
                                         ///< otherwise 4 times the surface's own
  const Displacer* displacer = nullptr;  ///< as in DiceSettings
  std::function<bool(const Attributes&, std::string_view name)> wants_primvar;
  int threads = 1;
};

/// Dices every surface of the scene, on screen or off, and builds what answers rays. Null when the
/// scene has no surfaces. Throws Error when the module cannot be loaded or memory runs out.
std::shared_ptr<const RayTracer> make_ray_tracer(const Scene& scene, const Camera& camera,
                                                 const RaySettings& settings,
                                                 Diagnostics& diagnostics);

}  // namespace tessera
