#pragma once
/// Light shaders: what reaches a batch of points from one light.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shade/parameters.h"
#include "shade/points.h"

namespace tessera {

/// What one light sends to a batch of points.
struct LightSamples {
  Vec3Array L;   ///< unit direction from the point towards the light; unused by ambient lights
  Vec3Array Cl;  ///< light colour arriving at the point; zero where the light does not reach
};

/// A light shader, one file of shade/lights/ each.
struct LightDefinition {
  std::string name;
  std::string help;
  std::vector<ParameterDeclaration> parameters;
  bool ambient = false;  ///< has no direction: counts in ambient, not in diffuse and specular
  /// Fills `out`, already sized and zeroed. Parameters are in camera space.
  void (*illuminate)(const BoundParameters& parameters, const ShadingPoints& points,
                     LightSamples& out) = nullptr;
  /// What the light cannot do yet, said once when a scene uses it; empty: nothing.
  std::string limitation;
};

std::span<const LightDefinition> light_registry();
/// The light called `name`, or null.
const LightDefinition* find_light(std::string_view name);

/// A light of the scene, ready to shine.
struct BoundLight {
  const LightDefinition* definition = nullptr;
  BoundParameters parameters;
};

}  // namespace tessera
