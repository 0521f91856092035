#pragma once
/// What crosses the border to the module that answers rays. Embree and what it links stay out of
/// the executable: a frame without rays does not load them.

#include <memory>
#include <string>
#include <vector>

#include "rays/near_range.h"
#include "shade/ray_tracer.h"

namespace tessera {

/// Everything rays may meet. All vectors have one entry a grid.
struct RayScene {
  std::vector<std::shared_ptr<const Grid>> grids;
  std::vector<float> passing;  ///< share of light that passes a layer, [0, 1]; 1: never a blocker
  std::vector<std::vector<NearRange>> near;  ///< [micropolygon]
  int threads = 1;                           ///< to build with
};

/// Loads the module from the file the environment variable TESSERA_EMBREE_MODULE names, or else
/// from tessera_embree.so beside the executable, and has it build a tracer. Throws Error naming the
/// file and the reason, or when memory runs out. The shared object stays loaded until the process
/// ends.
std::unique_ptr<RayTracer> make_module_ray_tracer(RayScene&& scene);

/// Entry point of the module: `tessera_ray_module_1`, to be renamed with any change of the
/// interfaces above or of RayTracer, so that modules of another build are refused.
using RayTracerFactory = RayTracer* (*)(RayScene&& scene);
inline constexpr const char* ray_module_entry = "tessera_ray_module_1";

}  // namespace tessera
