#pragma once
/// How each channel group is computed; the table is in aov.cpp.

#include "shade/fragment_geometry.h"
#include "shade/shade.h"

namespace tessera {

/// A sample after compositing front to back.
struct CompositedSample {
  glm::vec3 color{0.0f};    ///< sum of Ci seen through what is in front
  glm::vec3 opacity{0.0f};  ///< sum of Oi likewise, without that of matte surfaces
};

/// A channel group with its evaluator: one of the two functions is set. Both write the group's
/// channels to `out`.
struct AovEvaluator {
  AovDefinition definition;
  void (*of_sample)(const CompositedSample& sample, float* out) = nullptr;
  /// Of the nearest surface seen in a sample.
  void (*of_surface)(const ShadeInput& input, size_t fragment, const Camera& camera,
                     float* out) = nullptr;
};

/// The evaluator behind `definition`, by name. Throws Error when there is none.
const AovEvaluator& evaluator_of(const AovDefinition& definition);

}  // namespace tessera
