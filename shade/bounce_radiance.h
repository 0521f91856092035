#pragma once
/// What rays find on the surfaces they meet: the light that a surface sends out alike in all
/// directions, lit by everything but light that bounced before. Shaded at every second vertex of the
/// grids that rays are traced against, along u and v, apart for their two sides.

#include <array>
#include <memory>
#include <mutex>
#include <vector>

#include "shade/ray_tracer.h"

namespace tessera {

class ShaderBindings;
struct ShadeCounters;

/// Each side of a grid is shaded once, all in one batch, as its vertices are at shutter open (a
/// little inside where they lie on the rim of the grid), by whichever ray first meets it; what
/// comes out does not depend on which that was. Shadows are looked up at the vertices, distributed
/// lights summed over their fixed places, and surfaces that shine do not show it: area lights are
/// direct light already. Thread safe.
class BounceRadiance {
 public:
  /// Both must outlive this.
  BounceRadiance(const ShaderBindings& bindings, const RayTracer& rays);
  ~BounceRadiance();
  BounceRadiance(const BounceRadiance&) = delete;
  BounceRadiance& operator=(const BounceRadiance&) = delete;

  /// Fills `out` with what each ray met, `hits` of `rays`: the radiance of the side it came from,
  /// Ci already multiplied by opacity, interpolated between vertices; black where nothing was met,
  /// and at vertices where the shader gave values that are not finite, which are counted.
  void radiance(const Rays& rays, const RayHits& hits, Vec3Array& out,
                ShadeCounters& counters) const;
  /// Of what has been shaded so far. Not to be called while rays are traced.
  size_t memory_bytes() const;

 private:
  enum class Side { front, back };
  struct Vertices {
    std::array<std::once_flag, 2> shaded;            // [side]
    std::array<std::vector<glm::vec3>, 2> radiance;  // [side][vertex]
  };
  static Side side_met(const Grid& grid, const std::array<int, 3>& corners,
                       const glm::vec3& direction, float time);
  const std::vector<glm::vec3>& vertices_of(uint32_t grid, Side side,
                                            ShadeCounters& counters) const;
  std::vector<glm::vec3> shade(const Grid& grid, Side side, ShadeCounters& counters) const;

  const ShaderBindings& bindings_;
  const RayTracer& rays_;
  std::unique_ptr<Vertices[]> vertices_;  // [grid of the tracer]
};

}  // namespace tessera
