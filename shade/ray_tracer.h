#pragma once
/// Rays against the surfaces of a scene, for shaders and lights that ask for them. rays/ implements
/// this over a dice of its own; a frame in which nobody asks builds none of it.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "dice/grid.h"
#include "shade/values.h"

namespace tessera {

/// One entry a ray, in camera space. Distances along a ray are multiples of its direction, which
/// may have any length but zero; rays with a NaN or without a direction meet nothing.
struct Rays {
  Vec3Array origin, direction;
  std::vector<float> far;        ///< what lies at or beyond this distance is not met; may be infinite
  std::vector<float> time;       ///< shutter time in [0, 1]
  std::vector<int32_t> surface;  ///< Surface::id that the origin lies on, -1: none. That surface's
                                 ///< own dice does not get in the way close to the origin.

  explicit Rays(int count = 0) { reset(count); }
  void reset(int count) {
    origin.reset(count), direction.reset(count);
    far.assign(size_t(count), 0.0f), time.assign(size_t(count), 0.0f);
    surface.assign(size_t(count), -1);
  }
  int count() const { return origin.count(); }
};

/// The nearest surface that each ray meets, whatever its opacity.
struct RayHits {
  std::vector<float> distance;           ///< infinite: none, and the rest means nothing
  std::vector<uint32_t> grid, triangle;  ///< of RayTracer::grids(), and as in FragmentList
  std::vector<float> b1, b2;             ///< barycentric coordinates, as in FragmentList
};

/// What stands between the ends of each ray.
struct RayShadows {
  std::vector<float> share;     ///< of light that passes: the product of 1 - opacity over the blockers
  std::vector<float> distance;  ///< of the blocker nearest the origin; infinite: none
};

/// Immutable and thread safe. Results do not depend on how rays are batched.
class RayTracer {
 public:
  virtual ~RayTracer() = default;
  /// Resizes `hits` to the rays.
  virtual void closest(const Rays& rays, RayHits& hits) const = 0;
  /// Resizes `shadows` to the rays. Opacity is that of the surfaces' attributes (mean of the three);
  /// no shader runs. Surfaces with `Attribute "visibility" "transmission"` off block nothing.
  virtual void shadow(const Rays& rays, RayShadows& shadows) const = 0;
  /// What is met: every surface of the scene, in scene order, wherever it lies.
  virtual std::span<const std::shared_ptr<const Grid>> grids() const = 0;
  virtual size_t memory_bytes() const = 0;
};

}  // namespace tessera
