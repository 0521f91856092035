#pragma once
/// From the moments of a frame to its filtered colours.

#include <array>

#include "reconstruct/component.h"
#include "reconstruct/method.h"
#include "reconstruct/moment_layout.h"
#include "reconstruct/pixel_facts.h"

namespace tessera {

struct EffectFilterInput {
  const MomentLayout* layout = nullptr;
  const ReconstructionMethod* method = nullptr;
  const PixelFacts* facts = nullptr;  ///< smoothed
  const Planes* planes = nullptr;     ///< as StackFilterInput::planes
  NoiseCorrelation correlation;
  int noise_spread = 1;  ///< pixels to either side that may hold the same sample
  bool cancels = false;  ///< the pixel filter has weights below 0: sums may come to nearly nothing
};

/// Planes [channel][pixel], over the rectangle of the facts.
struct FilteredColors {
  Planes base;                                      ///< without ray effects
  std::array<Planes, ray_effect_count> received{};  ///< empty where the frame has no such effect
};

/// Filters each part of the colour along the coordinate that blurs it most for sure. What lights
/// and bounces bring is divided by what would arrive unblocked, filtered, and multiplied again, so
/// that textures and edges stay sharp.
FilteredColors filter_effects(const EffectFilterInput& input);

/// Planes that filter_effects() holds at the most, its input and its result not counted.
size_t effect_filter_planes(const MomentLayout& layout, const ReconstructionMethod& method);

/// Pixels to either side that filter_effects reads for one pixel, on top of the method's own.
int effect_filter_margin();

}  // namespace tessera
