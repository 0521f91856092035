#pragma once
/// Shadows of lights by rays.

#include <span>

#include "shade/light.h"

namespace tessera {

/// What stands between points and places of a light, one entry a point.
struct PlaceShadows {
  std::vector<float> share;     ///< of light that passes; 1 where no ray was asked for
  std::vector<float> distance;  ///< of the blocker nearest the point, in lengths of `towards`;
                                ///< infinite: none
  uint64_t rays = 0;            ///< how many were traced
};

/// Traces from each point along `towards`. To a light at a finite distance rays end just short of
/// it, so that a light that is a surface itself is not in its own way. Points where `towards` is
/// zero cast no ray. Without a tracer nothing is in the way.
void trace_shadows(const RayTracer* tracer, const ShadingPoints& points, const Vec3Array& towards,
                   bool infinite, PlaceShadows& out);

}  // namespace tessera
