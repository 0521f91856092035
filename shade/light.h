#pragma once
/// Light shaders: what reaches a batch of points from one light.

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shade/effects.h"
#include "shade/parameters.h"
#include "shade/points.h"

namespace tessera {

class BounceRadiance;
class Camera;
class RayTracer;
struct ShadeCounters;

struct BoundLight;
struct ShareSamples;
struct LightServices;
class Emitter;
class FrameTextures;
class ShadowSource;

/// What one light sends to a batch of points.
struct LightSamples {
  Vec3Array L;   ///< unit direction from the point towards the light; unused by ambient lights
  Vec3Array Cl;  ///< light colour arriving at the point; zero where the light does not reach
};

/// Where a light with extent lies, camera space at shutter open.
struct LightExtent {
  glm::vec3 centre{0.0f};
  /// Centre plus or minus these bounds the light along each. Zero where the light is flat; unit
  /// vectors in any order for infinite lights, whose offsets are tangential parts of directions.
  std::array<glm::vec3, 3> half_axes{glm::vec3(0.0f), glm::vec3(0.0f), glm::vec3(0.0f)};
  glm::vec3 normal{0.0f};  ///< unit, the way a flat light shines; zero for others
  float area_root = 0.0f;  ///< square root of the area, camera units
  bool round = false;      ///< an ellipse or ellipsoid; otherwise a box
  bool infinite = false;   ///< infinitely far away, all round
};

/// What a light with extent sends to a batch of points from one place of it to each.
struct PlaceSamples {
  LightSamples arriving;  ///< the mean over the places of Cl * max(0, N . L) is what it adds
  Vec3Array towards;      ///< from the point to the place, camera units; a unit direction to
                          ///< infinite lights; zero where there is nothing to be seen of it
  Vec3Array offset;  ///< of the place from LightExtent::centre, camera units; for infinite lights
                     ///< the part of the unit direction that is tangent to the surface
  uint64_t texture_lookups = 0;  ///< that it took to find this

  void reset(int count) {
    for (auto* array : {&arriving.L, &arriving.Cl, &towards, &offset}) array->reset(count);
    texture_lookups = 0;
  }
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
  /// Comes from all directions over the surface: counts in diffuse (or in ambient) as it is,
  /// without a cosine of its own.
  bool hemisphere = false;
  /// Fills `out`, already sized and zeroed, as if nothing stood in the light's way. Parameters are
  /// in camera space. Null for lights that have illuminate_from() instead.
  void (*illuminate)(const BoundParameters& parameters, const ShadingPoints& points,
                     LightSamples& out) = nullptr;
  /// Writes the share of that, in [0, 1], that reaches each point. May read P, N, dPdx and dPdy of
  /// the points (footprints may be missing), and `surface` and `time`, and nothing else: only these
  /// are there when shadows have a rate of their own. Called for lights for which
  /// BoundLight::casts_shadows(); null: nothing is ever in the way.
  void (*transmission)(const BoundLight& light, const ShadingPoints& points,
                       std::span<float> share) = nullptr;
  /// For lights with extent: fills `out`, already sized and zeroed, with what comes from place xi
  /// in [0, 1)^2 to each point, as if nothing stood in the way. Reads P, N and `time` of
  /// the points, where N is the side of the surface that the light is wanted on.
  void (*illuminate_from)(const BoundLight& light, const ShadingPoints& points,
                          std::span<const glm::vec2> xi, PlaceSamples& out) = nullptr;
  /// For those lights: where they lie; `camera_from_light` is the light's own space. Null for
  /// lights that get their BoundLight::extent from the surfaces that shine. Throws Error when the
  /// light can never shine, with what was found and expected but without the place in the file.
  LightExtent (*measure)(const BoundParameters& parameters,
                         const glm::dmat4& camera_from_light) = nullptr;
  /// For lights whose arrival is an integral over their extent (or over all directions), sampled at
  /// one place `xi` in [0, 1)^2 for each point: the mean over uniform xi of the share times what
  /// the light adds unblocked is what it adds. May read what `transmission` may, and `surface` and
  /// `time`. Such lights are `distributed`.
  void (*share_from)(const BoundLight& light, const ShadingPoints& points,
                     std::span<const glm::vec2> xi, const LightServices& services,
                     ShareSamples& out) = nullptr;
  /// Which effect those samples belong to.
  RayEffect effect = RayEffect::shadow;

  bool distributed() const { return share_from != nullptr; }
};

/// What share_from() finds, one entry a point.
struct ShareSamples {
  Vec3Array share;  ///< of what the light adds unblocked; may exceed 1
  Vec3Array open;   ///< the same if nothing were in the way; counts only for RayEffect::shadow
  std::array<AlignedVector<float>, 2> y, extent;  ///< as in EffectValues
  AlignedVector<float> slope;                     ///< as in EffectValues

  void reset(int count) {
    share.reset(count), open.reset(count);
    for (auto* pair : {&y, &extent})
      for (auto& axis : *pair) axis.assign(padded(size_t(count)), 0.0f);
    slope.assign(padded(size_t(count)), std::numeric_limits<float>::quiet_NaN());
  }
};

/// What lights may call on.
struct LightServices {
  const Camera* camera = nullptr;
  const RayTracer* rays = nullptr;         ///< null: nothing is in the way and nothing bounces
  const BounceRadiance* bounce = nullptr;  ///< null: what rays meet is black
  ShadeCounters* counters = nullptr;
  FrameTextures* textures = nullptr;  ///< null: lights have no maps
  /// At the points of this call, the mean over the light's places of Cl cos; null: not known yet.
  const Vec3Array* mean_received = nullptr;
};

std::span<const LightDefinition> light_registry();
/// The light called `name`, or null.
const LightDefinition* find_light(std::string_view name);

/// A light of the scene, ready to shine.
struct BoundLight {
  const LightDefinition* definition = nullptr;
  BoundParameters parameters;
  ShadowSource* shadow = nullptr;            ///< depth map; null: none
  bool ray_traced = false;                   ///< shadows by rays, if there are any
  std::shared_ptr<const Emitter> emitter{};  ///< the surfaces that shine; only of area lights
  TermRate rate = TermRate::cell;
  /// Which of SurfaceColors::light_terms is this light's; only where the rate is not `cell`.
  std::optional<size_t> term{};
  /// Which of them is its own diffuse light, the mean over its places: what share_from() relates
  /// one place to. Only of lights with a term and `illuminate_from`.
  std::optional<size_t> mean_term{};
  SourceLocation where{};
  /// What the frame offers to its lights, without counters; null: nothing. Outlives the light.
  const LightServices* services = nullptr;
  glm::dmat4 camera_from_light{1.0};  ///< at shutter open
  LightExtent extent{};               ///< of lights with extent
  /// Where a distributed light is summed over: well spread over [0, 1)^2, the same for all points.
  std::vector<glm::vec2> places{};
  /// The same where no rays are cast; more of them for lights with a term.
  std::vector<glm::vec2> open_places{};

  /// Whether transmission() has anything to say.
  bool casts_shadows() const { return shadow || ray_traced; }
};

/// LightDefinition::illuminate_from of a light that has it, into `out` whatever that held before.
/// Counts the light's look-ups of textures unless `counters` is null.
void illuminate_from(const BoundLight& light, const ShadingPoints& points,
                     std::span<const glm::vec2> xi, ShadeCounters* counters, PlaceSamples& out);

}  // namespace tessera
