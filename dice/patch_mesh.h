#pragma once
/// Patch and PatchMesh: rectangular meshes of bilinear or bicubic patches, open or periodic.

#include "dice/moving_points.h"
#include "dice/patch.h"

namespace tessera {

/// `surface` must hold a PatchMesh; it and `points` must outlive the set.
std::unique_ptr<PatchSet> make_patch_mesh_patches(const Surface& surface,
                                                  const MovingPoints& points);

/// Evaluates a primitive variable given at the control points of a tensor-product Bezier patch,
/// [j * (u_degree + 1) + i][component], with the weights of a rational one (or none).
std::function<void(std::span<const float>, std::span<const float>, float*, size_t)>
bezier_primvar_evaluator(int u_degree, int v_degree, int components, std::vector<double> values,
                         std::vector<double> weights);

}  // namespace tessera
