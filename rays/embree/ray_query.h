#pragma once
/// One ray on its way through Embree, and the filters that decide what it meets.

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include <embree3/rtcore.h>

#include "rays/near_range.h"

namespace tessera {

/// What filters know of a micropolygon, together in memory: they are called for many, far apart.
struct MetMicropolygon {
  NearRange near;        ///< in Embree's units
  int32_t surface = -1;  ///< Surface::id
  uint32_t grid = 0;     ///< of the scene
};

/// What filters know of a grid.
struct MetGrid {
  bool opaque = true;               ///< no light passes
  bool blocks = true;               ///< false: all light passes
  int64_t log2_passing = 0;         ///< log2 of the share that passes, times 2^32, if neither
  uint32_t first_micropolygon = 0;  ///< primitive / 2, in its geometry
};

/// User data of an Embree geometry: many grids, one after the other.
struct MetGeometry {
  const MetGrid* grids = nullptr;              ///< of the scene
  std::vector<MetMicropolygon> micropolygons;  ///< [primitive / 2]
};

/// Extends Embree's context by what the filters need. Direction of unit length.
struct RayQuery {
  RTCIntersectContext context;  ///< first: Embree hands back a pointer to it
  int32_t surface = -1;         ///< that the origin lies on
  float height_noise = 0;       ///< height of an origin that may be on any plane; Embree's units

  /// Of the hit that was kept last. Equal distances go to the smaller name, so that the order in
  /// which Embree looks at triangles, which threads may change, does not matter.
  float kept_t = std::numeric_limits<float>::infinity();
  uint64_t kept_name = ~uint64_t(0);

  /// Layers that let some light pass. A ray through the edge of two triangles meets both at once:
  /// that is one layer. Logarithms in fixed point add up to the same in any order.
  struct Layer {
    int32_t surface;
    float t;
  };
  std::array<Layer, 32> layers;  ///< the first that Embree proposed
  size_t layer_count = 0;
  std::vector<Layer> further_layers;  ///< those after them: few rays meet as many
  float nearest_layer_t = std::numeric_limits<float>::infinity();
  int64_t log2_passing = 0;
};

/// Filters of RTCIntersectContext for a RayQuery, one ray at a time.
/// Keeps the nearest hit.
void keep_nearest(const RTCFilterFunctionNArguments* arguments);
/// Keeps the nearest hit that no light passes and takes down the others; leaves out grids that do
/// not block.
void keep_nearest_opaque(const RTCFilterFunctionNArguments* arguments);

}  // namespace tessera
