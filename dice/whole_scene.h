#pragma once
/// All grids of a scene at once, whether the camera sees them or not: what rays may meet.

#include <memory>
#include <vector>

#include "dice/dice.h"

namespace tessera {

/// Micropolygons that one surface is diced into at most, unless it has more patches than a quarter
/// of that.
inline constexpr size_t most_micropolygons_of_surface = size_t(1) << 20;

/// Dices every surface of the scene, in parallel. Grids come by surface, then face, then along the
/// splits, lower halves first. They are the same bits for any number of threads, and those of one
/// surface share the vertices of their edges like any others.
///
/// A micropolygon has the size that is asked for where it is seen squarely. What is foreshortened
/// or out of the frame counts as half as long as if it was turned to the eye in the middle of the
/// frame, at its own distance, for rays come from anywhere. Nothing counts as nearer than 1/64 of
/// the largest extent of the scene. A surface that would need more than `most_micropolygons` is
/// diced coarser as a whole, and reported; its vertices then no longer agree with those of separate
/// surfaces that it touches. Blur coarsens nothing. Of `settings` the crop, bucket size and memory
/// budget mean nothing here.
///
/// Surfaces that cannot be evaluated, and grids with vertices that are not finite, are left out as
/// by make_grid_source. `scene` must outlive the grids.
std::vector<std::shared_ptr<const Grid>> dice_whole_scene(
    const Scene& scene, const Camera& camera, const DiceSettings& settings,
    Diagnostics& diagnostics, size_t most_micropolygons = most_micropolygons_of_surface);

}  // namespace tessera
