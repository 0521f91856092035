#pragma once
/// What a frame needs, and so all that it will pay for: derived once from the scene and the
/// settings, handed to every stage, printed with --verbose and stored in the statistics.

#include <string>
#include <utility>
#include <vector>

#include "cameras/camera_settings.h"
#include "engine/settings.h"
#include "hide/samples.h"
#include "reconstruct/reconstruct.h"
#include "scenes/scene.h"

namespace tessera {

class ShaderBindings;

struct FramePlan {
  bool motion = false;        ///< camera or some surface moves while the shutter is open
  bool lens = false;          ///< the lens is open
  bool transparency = false;  ///< some surface may let others show through
  bool displacement = false;  ///< some surface has a displacement shader
  bool textures = false;      ///< some surface's shader, or a light's that shines on it, names a
                              ///< texture: the image library is loaded
  bool area_lights = false;   ///< some light has extent, and each sample a place of its own on it
  bool bounce = false;        ///< some light comes from all around, by a ray of each sample's own
  bool ray_tracing = false;   ///< some light asks for rays, and there is something to meet

  int samples_per_pixel = 16;  ///< of a frame of one pass; hiders may want multiples of it
  std::string samples_found;   ///< in words, where an error or a time finds how many; else empty
  int bucket_size = 32;
  int grid_size = 32;
  /// Area of a micropolygon over that of a shading cell, where it is largest.
  float dicing_ratio = 1;
  /// GeometricApproximation of surfaces that say nothing, or as the settings say. By default the
  /// largest powers of two whose error stays below half of the noise at 64 samples a pixel
  /// (docs/dicing.md, Blur).
  float motion_factor = 2, focus_factor = 8;
  std::string hider = "auto", shading = "aas";
  /// How samples become pixels: "filter", or a method for distribution effects (reconstruct/).
  std::string reconstruct = "filter";
  int extra_samples = 0;  ///< most a pixel may have besides those of a pass
  std::string filter = "gaussian";
  float filter_x_width = 2, filter_y_width = 2;
  std::vector<std::string> channel_groups;  ///< AOVs to compute
  SampleTuples sample_tuples;               ///< what the hider wants of the samples

  DistributionFeatures distribution() const { return {lens, motion, area_lights, bounce}; }
  /// Whether a method for distribution effects runs, not the pixel filter alone.
  bool filters_distribution() const { return reconstruct != "filter"; }
  /// (name, value) of every entry, for printing and for the statistics.
  std::vector<std::pair<std::string, std::string>> entries() const;
};

FramePlan make_plan(const Scene& scene, const CameraSettings& camera, const Settings& settings,
                    const ShaderBindings& bindings);

}  // namespace tessera
