#pragma once
/// Light shaders: what reaches a batch of points from one light.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shade/parameters.h"
#include "shade/points.h"

namespace tessera {

struct BoundLight;
class ShadowSource;

/// What one light sends to a batch of points.
struct LightSamples {
  Vec3Array L;   ///< unit direction from the point towards the light; unused by ambient lights
  Vec3Array Cl;  ///< light colour arriving at the point; zero where the light does not reach
};

/// How often the shadows of a light are looked up.
enum class TermRate {
  cell,   ///< where the surface is shaded
  pixel,  ///< once for each grid seen in a pixel
  sample  ///< for everything a sample sees
};

/// A light shader, one file of shade/lights/ each.
struct LightDefinition {
  std::string name;
  std::string help;
  std::vector<ParameterDeclaration> parameters;
  bool ambient = false;  ///< has no direction: counts in ambient, not in diffuse and specular
  /// Fills `out`, already sized and zeroed, as if nothing stood in the light's way. Parameters are
  /// in camera space.
  void (*illuminate)(const BoundParameters& parameters, const ShadingPoints& points,
                     LightSamples& out) = nullptr;
  /// Writes the share of that, in [0, 1], that reaches each point. May read P, N, dPdx and dPdy of
  /// the points (footprints may be missing) and nothing else: only these are there when shadows
  /// have a rate of their own. Called for lights with a BoundLight::shadow; null: nothing is ever
  /// in the way.
  void (*transmission)(const BoundLight& light, const ShadingPoints& points,
                       std::span<float> share) = nullptr;
};

std::span<const LightDefinition> light_registry();
/// The light called `name`, or null.
const LightDefinition* find_light(std::string_view name);

/// A light of the scene, ready to shine.
struct BoundLight {
  const LightDefinition* definition = nullptr;
  BoundParameters parameters;
  ShadowSource* shadow = nullptr;  ///< null: casts no shadows
  TermRate rate = TermRate::cell;
  /// Which of SurfaceColors::light_terms is this light's; only where the rate is not `cell`.
  std::optional<size_t> term{};
};

}  // namespace tessera
