#pragma once
/// All grids of a scene at once, whether the camera sees them or not: what rays may meet, and what
/// shines.

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
/// Surfaces of area lights that are not flat are diced as by dice_emitters(), into the same bits,
/// so that a ray that ends where one shines ends on what it meets: a finer or coarser dice would be
/// in its way.
///
/// Surfaces that cannot be evaluated, and grids with vertices that are not finite, are left out as
/// by make_grid_source. `scene` must outlive the grids.
std::vector<std::shared_ptr<const Grid>> dice_whole_scene(
    const Scene& scene, const Camera& camera, const DiceSettings& settings,
    Diagnostics& diagnostics, size_t most_micropolygons = most_micropolygons_of_surface);

/// Micropolygons of dice_emitters() around a full turn.
inline constexpr int emitter_segments_of_turn = 128;
/// Micropolygons that it dices a surface that is not flat, and one that is displaced, into about,
/// at least: for what shows no turn where it is sampled.
inline constexpr size_t emitter_micropolygons_of_curved = size_t(1) << 10;
inline constexpr size_t emitter_micropolygons_of_displaced = size_t(1) << 14;
/// So many surfaces that are not flat are diced so. Of more of them micropolygons are as much
/// larger, so that a thousand lamps take no more, but no more than `emitter_most_area` times.
inline constexpr size_t emitters_at_full_rate = 64;
inline constexpr int emitter_most_area = 16;

/// Dices every surface of the scene that is part of an area light, by shape alone: where the camera
/// is, its format and all rates mean nothing (but for rounding: positions are in camera space).
/// Keys and the order of grids are as in dice_whole_scene(). Flat quadrangles and triangles are one
/// micropolygon each, and what is curved has `emitter_segments_of_turn` a full turn, along u and
/// along v. A ball lacks 0.05% of its area and of its light. What displacement does is not known
/// before: such surfaces are diced evenly, finer where they are curved.
std::vector<std::shared_ptr<const Grid>> dice_emitters(const Scene& scene, const Camera& camera,
                                                       const DiceSettings& settings,
                                                       Diagnostics& diagnostics);

}  // namespace tessera
