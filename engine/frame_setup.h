#pragma once
/// What the stages of a frame are told, derived from the plan.

#include <memory>
#include <vector>

#include "cameras/camera.h"
#include "dice/dice.h"
#include "engine/buckets.h"
#include "engine/plan.h"
#include "rays/rays.h"
#include "reconstruct/reconstruct.h"
#include "shade/shade.h"

namespace tessera {

/// Textures come from the image module, which is loaded at the first lookup only. `scene` and the
/// rest must outlive what is made of it.
ShadeSetup shade_setup(const Scene& scene, const Camera& camera, const Settings& settings,
                       Diagnostics& diagnostics);

ShadingFrame shading_frame(const FramePlan& plan, std::shared_ptr<const ShaderBindings> bindings);

DiceSettings dice_settings(const FramePlan& plan, const BucketLayout& buckets,
                           const Settings& settings, const Displacer* displacer,
                           std::shared_ptr<const ShaderBindings> bindings);

/// Null when nothing asks for rays.
std::shared_ptr<const RayTracer> ray_tracer(const FramePlan& plan, const Scene& scene,
                                            const Camera& camera, const Settings& settings,
                                            const DiceSettings& seen, int threads,
                                            Diagnostics& diagnostics);

BucketLayout bucket_layout(const FramePlan& plan, const Camera& camera);

/// Pixels above and below one whose samples it needs.
int rows_needed(const FramePlan& plan);

/// All but the method. `exposure_gamma` as FilmSettings' own: 1 where pixels are wanted linear.
ReconstructionSettings reconstruction_settings(const FramePlan& plan, const BucketLayout& buckets,
                                               const Camera& camera,
                                               const std::vector<const AovDefinition*>& groups,
                                               float exposure_gain, float exposure_gamma,
                                               int threads, size_t moment_bytes);

/// Settings::threads, or every core. Throws Error outside 0 to max_threads.
int thread_count(const Settings& settings);

}  // namespace tessera
