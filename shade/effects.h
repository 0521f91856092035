#pragma once
/// Distribution effects: what a sample brings besides its colour, so that reconstruct/ can share
/// samples between pixels (L. Wu et al., "Multiple axis-aligned filters for rendering of combined
/// distribution effects", EGSR 2017).
///
/// Each effect has a coordinate that samples are spread over: the place on a light, the direction
/// of a bounce, the place on the lens, the time. Seen from a pixel at x, what a sample finds at
/// coordinate y is a pattern of the surface shifted along the image: f(x, y) = g(x + slope * extent
/// * y) along each image axis, with `extent` in pixels. The slopes met near a pixel
/// bound the double wedge of its spectrum.

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace tessera {

/// Coordinates are scaled so that y has a mean square of 1/3, as if it were uniform over [-1, 1]:
/// those of discs and of lights that lie askew reach beyond.
inline constexpr float farthest_coordinate = 2.0f;
/// sqrt(3) times the standard deviation of a coordinate of a point uniform in the unit disc.
inline constexpr float disc_spread = 0.8660254f;

/// Effects whose samples are rays of their own.
enum class RayEffect : uint8_t {
  shadow,  ///< light from lights with extent
  bounce   ///< light that comes from other surfaces, or from the distance past them
};
inline constexpr size_t ray_effect_count = 2;

/// One effect in what is seen: one entry a fragment or a sample. Empty where the frame has no such
/// effect.
struct EffectValues {
  /// What arrived of it, a part of Ci: `unblocked` times what the sample's own ray found.
  std::array<std::vector<float>, 3> received;
  /// shadow: what would arrive if nothing were in the way. bounce: what would arrive if light of 1
  /// came from everywhere. Free of the noise of rays.
  std::array<std::vector<float>, 3> unblocked;
  /// What would arrive from the sample's own place if nothing were in its way: `unblocked` in the
  /// mean. With it, the noise of places that are brighter than others can be told from that of
  /// shadows. Empty: `unblocked`.
  std::array<std::vector<float>, 3> drawn;
  std::array<std::vector<float>, 2> y;       ///< along image x and y
  std::array<std::vector<float>, 2> extent;  ///< pixels, at slope 1; 0: not known
  std::vector<float> slope;                  ///< >= 0; NaN: the ray met nothing

  bool empty() const { return slope.empty(); }
  void resize(size_t count) {
    for (auto* colors : {&received, &unblocked})
      for (auto& channel : *colors) channel.assign(count, 0.0f);
    for (auto* pairs : {&y, &extent})
      for (auto& axis : *pairs) axis.assign(count, 0.0f);
    slope.assign(count, std::numeric_limits<float>::quiet_NaN());
    for (auto& channel : drawn) channel.clear();
  }
  void add_drawn() {
    for (auto& channel : drawn) channel.assign(slope.size(), 0.0f);
  }
};
using RayEffects = std::array<EffectValues, ray_effect_count>;

/// The surface nearest the eye at each sample.
struct SampleSurfaces {
  /// Raster shift per unit lens coordinate, pixels, signed: f(x, u) = g(x - coc * u). Empty with a
  /// closed lens.
  std::array<std::vector<float>, 2> coc;
  /// Raster shift from shutter open to close, pixels: f(x, t) = g(x - velocity * t). Empty if
  /// nothing moves.
  std::array<std::vector<float>, 2> velocity;
  std::array<std::vector<float>, 3> N;  ///< unit, camera space; zero where nothing is seen
  std::vector<uint32_t> surface;        ///< Surface::id + 1; 0 where nothing is seen
};

/// Everything that filters for distribution effects need of a bucket's samples.
struct DistributionSamples {
  RayEffects effects;  ///< composited
  SampleSurfaces surfaces;
  std::vector<float> u, v, t;  ///< as in SampleBlock
};

}  // namespace tessera
