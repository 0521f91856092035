#pragma once
/// Spheres, cones, cylinders, hyperboloids, paraboloids, disks and tori: a profile curve swept
/// about the z axis, in closed form.

#include "dice/moving_points.h"
#include "dice/patch.h"

namespace tessera {

/// `surface` must hold a Quadric; it and `points` must outlive the set.
std::unique_ptr<PatchSet> make_quadric_patches(const Surface& surface, const MovingPoints& points);

}  // namespace tessera
