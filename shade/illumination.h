#pragma once
/// The light-gathering functions of the RenderMan Interface (version 3.2, section 16.6): ambient(),
/// diffuse() and specular(), for a batch of points and in one pass over the lights.

#include <span>

#include "shade/light.h"
#include "shade/shade.h"

namespace tessera {

/// Sums over the lights, one entry a point. Where the cell's normals are known to vary, the clamped
/// cosine and the power are means over them (shade/normal_spread.h).
struct Illumination {
  Vec3Array ambient;   ///< sum of the ambient lights
  Vec3Array diffuse;   ///< sum of Cl * max(0, N . L)
  Vec3Array specular;  ///< sum of Cl * max(0, N . H)^(1 / roughness) where N . L > 0,
                       ///< H = normalize(L - I)
};

enum class Shadows { cast, left_out };

/// Gathers light on surfaces with unit normals `N` that face the eye. `roughness` null: no
/// specular. Lights with extent are summed over their places. Adds to `counters` one light
/// evaluation for each point and light or place of it, and one shadow look-up or ray for each
/// shadow that was cast.
void gather_light(std::span<const BoundLight* const> lights, const ShadingPoints& points,
                  const Vec3Input& N, const ScalarInput* roughness, Shadows shadows,
                  Illumination& out, ShadeCounters& counters);

}  // namespace tessera
