#pragma once
/// Stage header: shade. Visible fragments and their grids go in; colour, opacity and auxiliary
/// values (AOVs) come out. Shaders run over batches of points, never one at a time.

#include <array>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/counters.h"
#include "base/diagnostics.h"
#include "cameras/camera.h"
#include "dice/dice.h"
#include "hide/hide.h"
#include "images/texture_sampler.h"
#include "scenes/scene.h"
#include "shade/effects.h"
#include "shade/ray_tracer.h"

namespace tessera {

/// What shading is set up from; everything outlives the shading.
struct ShadeSetup {
  const Scene* scene = nullptr;
  const Camera* camera = nullptr;
  Diagnostics* diagnostics = nullptr;
  /// Called at the first texture lookup of a frame, so that a scene without textures never loads
  /// an image library. May throw Error.
  std::function<std::shared_ptr<TextureSampler>()> texture_sampler;
};

/// One bucket's work.
struct ShadeInput {
  const FragmentList* fragments = nullptr;
  std::span<const std::shared_ptr<const Grid>> grids;  ///< as FragmentList::grid counts them
  const SampleBlock* samples = nullptr;
  bool wants_cells = false;  ///< fill ShadedFragments::cell
  /// Where the points shaded for this bucket lie on the raster is appended here, each point of the
  /// frame once, in the bucket that first needs it: at shutter open, or, where shading is tied to
  /// samples, where the first of them lies. Points that have no such place (grids that reach behind
  /// the camera plane) are left out. Null: nobody asks.
  std::vector<glm::vec2>* shaded_at = nullptr;
};

/// Per fragment, linear: colour Ci already multiplied by opacity, opacity Oi. A fragment whose
/// shader failed may be NaN in Ci: its sample then counts for nothing.
struct ShadedFragments {
  std::array<std::vector<float>, 3> Ci, Oi;
  /// [term] As SurfaceColors::light_terms (shade/shader.h).
  std::vector<std::array<std::vector<float>, 3>> light_terms;
  RayEffects effects;  ///< the parts of Ci that rays of the samples' own brought
  /// If asked for, a hash of the cell of its grid that lies over its pixel at shutter open: where
  /// there is no blur the cell that it was shaded by.
  std::vector<uint32_t> cell;
};

/// What a fragment asks a memo of shaded values for: the name of its cell, and of the block of 2 x
/// 2 cells that graphics hardware would shade at once. Equal names, equal values.
struct ShadingRequest {
  uint64_t point = 0, quad = 0;
};

struct ShadeCounters {
  uint64_t grids_shaded = 0, points_shaded = 0, light_evaluations = 0, texture_lookups = 0;
  uint64_t shadow_lookups = 0, rays = 0, nonfinite_dropped = 0;
  uint64_t bounce_points_shaded = 0;  ///< of surfaces as rays meet them
  static constexpr auto fields() {
    using C = ShadeCounters;
    return std::array{CounterField<C>{"grids_shaded", &C::grids_shaded},
                      CounterField<C>{"points_shaded", &C::points_shaded},
                      CounterField<C>{"light_evaluations", &C::light_evaluations},
                      CounterField<C>{"texture_lookups", &C::texture_lookups},
                      CounterField<C>{"shadow_lookups", &C::shadow_lookups},
                      CounterField<C>{"rays", &C::rays},
                      CounterField<C>{"nonfinite_dropped", &C::nonfinite_dropped},
                      CounterField<C>{"bounce_points_shaded", &C::bounce_points_shaded}};
  }
};

/// Turns hits into radiance: hit -> cell -> shaded once -> radiance. Which cells there are is the
/// shading mode's choice. Thread safe; the result never depends on which bucket asked first.
class Shading {
 public:
  virtual ~Shading() = default;
  virtual void shade(const ShadeInput& input, ShadedFragments& out, ShadeCounters& counters) = 0;
  /// Appends what fragment `fragment` asks for: one request or, if the mode interpolates, several.
  /// For measuring; shades nothing.
  virtual void requests(const ShadeInput& input, size_t fragment,
                        std::vector<ShadingRequest>& out) = 0;
};

/// The shaders, lights and textures of a scene, bound once per frame.
class ShaderBindings;

/// What a shading mode is made for.
struct ShadingFrame {
  std::shared_ptr<const ShaderBindings> bindings;
  bool motion = false, lens = false;  ///< as in HideFeatures
  /// Frequency in cycles per pixel within which a share of the pixel filter's energy lies; null: no
  /// filter to speak of.
  std::function<double(double energy_share)> pixel_filter_band_limit{};
  /// Area of a micropolygon over that of a shading cell, as far as the settings say.
  float dicing_ratio = 1.0f;
};

/// A shading mode, one file of shade/modes/ each. `--shading name:arguments` picks and tunes it.
struct ShadingModeDefinition {
  const char* name;
  const char* help;
  /// Throws Error on bad arguments.
  std::unique_ptr<Shading> (*make)(std::string_view arguments, const ShadingFrame& frame);
};
std::span<const ShadingModeDefinition> shading_mode_registry();
/// `spec` is "name" or "name:arguments"; throws Error that lists the choices when unknown.
std::unique_ptr<Shading> make_shading(std::string_view spec, const ShadingFrame& frame);

/// Looks up every shader and light of the scene; unknown ones warn once and use the defaults.
std::shared_ptr<ShaderBindings> bind_shaders(const ShadeSetup& setup);
/// Whether some shader or light asks for rays.
bool wants_rays(const ShaderBindings& bindings);
/// Whether some light shines from surfaces of the scene.
bool wants_emitters(const ShaderBindings& bindings);
/// Whether some light's samples are rays of each sample's own.
bool has_effect(const ShaderBindings& bindings, RayEffect effect);
/// Hands over the grids of those surfaces (dice/whole_scene.h), before the first shade(). Without
/// it they light nothing. Throws Error, with the place in the scene file, where a light has no
/// area.
void use_emitters(ShaderBindings& bindings, std::span<const std::shared_ptr<const Grid>> grids);
/// Hands over what answers rays, before the first shade(). Without it nothing is in the way of
/// light and nothing bounces.
void use_rays(ShaderBindings& bindings, std::shared_ptr<const RayTracer> rays);
/// Memory of what has been shaded of surfaces as rays meet them. Not to be called while somebody
/// shades.
size_t bounce_bytes(const ShaderBindings& bindings);
/// The displacement shaders of the scene, for dice/; null when no surface has one.
std::unique_ptr<Displacer> make_displacer(std::shared_ptr<const ShaderBindings> bindings);
/// Whether anything seen through such a surface could show: opacity below 1, or a shader or
/// primitive variable that may set it.
bool may_be_transparent(const ShaderBindings& bindings, const Surface& surface);
/// Whether a surface's shaders read the primitive variable `name`.
bool wants_primvar(const ShaderBindings& bindings, const Attributes& attributes,
                   std::string_view name);

/// How a channel's samples become a pixel.
enum class ChannelFilter { filtered, closest };  ///< closest: the value of the nearest surface seen

/// A channel group that a Display or --aov can ask for (table in shade/aov.cpp): "rgb", "a", "z",
/// "Ci", "Oi", "direct", "indirect", "P", "N", "st", "motion", "id", "cell".
struct AovDefinition {
  const char* name;
  const char* help;
  std::vector<std::string> channels;  ///< EXR channel names: R G B; A; Z; P.x P.y P.z; ...
  ChannelFilter filter;
  float background;       ///< where nothing is seen
  bool of_cells = false;  ///< needs ShadeInput::wants_cells
};
std::span<const AovDefinition> aov_registry();
/// Throws Error that lists the choices when unknown.
const AovDefinition& find_aov(std::string_view name);

/// Fills `out` for a bucket: the effects in `shaded` composited as Ci is, and the nearest surfaces.
/// `lens` and `motion` as in HideFeatures. An effect that `shaded` does not have stays empty, as in
/// a bucket where nothing is seen.
void describe_samples(const ShadeInput& input, const ShadedFragments& shaded, const Camera& camera,
                      bool lens, bool motion, DistributionSamples& out);

/// Composites every sample front to back and evaluates the requested groups. `out[i]` receives the
/// channels of groups[i] one after another: out[i][channel * samples + sample]. Matte surfaces hold
/// out what is behind them and add nothing.
void composite(const ShadeInput& input, const ShadedFragments& shaded, const Camera& camera,
               std::span<const AovDefinition* const> groups, std::vector<std::vector<float>>& out);

}  // namespace tessera
