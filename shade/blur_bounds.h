#pragma once
/// How much a grid is blurred at least, by motion and by the lens: what the frequencies of its
/// shading that can be seen depend on (Vaidyanathan et al. 2012, Adaptive Image Space Shading for
/// Motion and Defocus Blur, section 3.2).
///
/// Seen through the lens centre, a vertex that moves linearly in camera space from (X0, W0) to
/// (X1, W1) in time d has the raster velocity (X1 W0 - X0 W1) / (d W^2) at depth W, and so for Y:
/// it keeps its direction, and is slowest where W is largest. Of the two ends of a segment between
/// motion keys, the deeper one therefore decides over the distance of the velocities' convex hull
/// from the origin, and either over the directions.

#include "cameras/camera.h"
#include "dice/grid.h"

namespace tessera {

/// How a grid is blurred at least, over all its vertices and the whole shutter.
struct BlurBounds {
  float min_speed = 0;          ///< pixels per shutter, seen through the lens centre; 0: stands
                                ///< still somewhere, or not bounded
  glm::vec2 direction{1, 0};    ///< unit, raster; centre of the directions of motion
  float half_span_radians = 0;  ///< directions lie within this of `direction`; at most pi / 2
  float min_coc = 0;            ///< pixels per unit lens coordinate; 0 where it changes sign
};

/// Bounds the raster velocities (`motion`) and the circle of confusion (`lens`) of `grid`. What is
/// not asked for, does not exist (one motion key; a closed lens) or cannot be bounded is 0; nothing
/// can be where a vertex is not in front of the camera plane or not finite.
///
/// Conservative for the vertices: min_speed is at most the distance from the origin to the convex
/// hull of all velocities, and at least 0.99 of it unless that is within rounding of 0 (less than
/// 1e-12 of the largest), where 0 is returned; all velocities lie within half_span_radians of
/// `direction`; min_coc is at most the radius (of x and y, the smaller) at any vertex and time.
/// With min_speed 0, `direction` and half_span_radians mean nothing. (Inside a micropolygon, the
/// velocity differs from a mean of its vertices' by the covariance, over the vertices, of raster
/// position and relative rate of depth: second order in the size of the micropolygon.)
BlurBounds blur_bounds(const Grid& grid, const Camera& camera, bool motion, bool lens);

}  // namespace tessera
