#pragma once
/// SIMD loops over the raster velocities of a grid's vertices. Sums are not fused, and ties go to
/// the first vertex, so that results do not depend on the width of the vectors.

#include <cstddef>

#include <glm/glm.hpp>

#include "cameras/camera.h"

namespace tessera {

/// Velocities as two runs of `count` doubles with room for velocity_padding more.
struct Velocities {
  const double* x = nullptr;
  const double* y = nullptr;
  size_t count = 0;
  glm::dvec2 operator[](size_t i) const { return {x[i], y[i]}; }
};
inline constexpr size_t velocity_padding = 8;

/// Camera-space positions at one key, runs padded as those of a grid.
struct KeyPositions {
  const float *x, *y, *z;
};

/// Writes the slower of the raster velocities at both ends of a segment, pixels per shutter, of
/// `count` vertices to (x, y), and what is meaningless to the velocity_padding elements after them.
/// `duration` in shutters. W must be positive at both ends. No product of two coordinates is
/// rounded, so the result is exact but for a few ulps, however slow the motion.
void slowest_velocities(const RasterClipMap& map, const KeyPositions& begin,
                        const KeyPositions& end, double duration, size_t count, double* x,
                        double* y);

/// Extremes of velocity components, and whether all are finite.
struct VelocityBox {
  glm::dvec2 low{0.0}, high{0.0};
  bool finite = true;
};
VelocityBox velocity_box(const Velocities& velocities);

/// The first velocity for which dot(along, velocity) is least.
size_t least_along(const Velocities& velocities, glm::dvec2 along);

/// The first velocities farthest to the negative and the positive side of `axis`: for which
/// cross(axis, velocity) / dot(axis, velocity) is least and greatest. All of dot must be positive.
struct ArcEnds {
  size_t least = 0, greatest = 0;
};
ArcEnds arc_ends(const Velocities& velocities, glm::dvec2 axis);

}  // namespace tessera
