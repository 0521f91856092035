#pragma once
/// How each channel group is computed; the table is in aov.cpp.

#include "shade/fragment_geometry.h"
#include "shade/shade.h"

namespace tessera {

/// A sample after compositing front to back.
struct CompositedSample {
  glm::vec3 color{0.0f};     ///< sum of Ci seen through what is in front
  glm::vec3 opacity{0.0f};   ///< sum of Oi likewise, without that of matte surfaces
  glm::vec3 indirect{0.0f};  ///< the part of the colour that bounces of RayEffect::bounce brought
};

/// What values of surfaces are made from.
struct AovInput {
  const ShadeInput& bucket;
  const ShadedFragments& shaded;
  const Camera& camera;
};

/// A channel group with its evaluator: one of the two functions is set. Both write the group's
/// channels to `out`.
struct AovEvaluator {
  AovDefinition definition;
  void (*of_sample)(const CompositedSample& sample, float* out) = nullptr;
  /// Of the nearest surface seen in a sample.
  void (*of_surface)(const AovInput& input, size_t fragment, float* out) = nullptr;
  /// The sample of a pixel that was taken nearest to shutter open and the lens centre stands for
  /// all of them, so that what lies still in shading space is not scattered by the blur.
  bool at_opening = false;
};

/// Raster shift from shutter open to close of the point that a fragment shows, through the lens
/// centre, pixels; zero where it does not move or has no place on the raster at both ends.
glm::vec2 raster_motion(const FragmentGeometry& seen, const Camera& camera);

/// The evaluator behind `definition`, by name. Throws Error when there is none.
const AovEvaluator& evaluator_of(const AovDefinition& definition);

}  // namespace tessera
