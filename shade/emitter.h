#pragma once
/// The surfaces of an area light as triangles, from which places are drawn in proportion to area.

#include <memory>
#include <span>
#include <vector>

#include "dice/grid.h"
#include "shade/extended_light.h"

namespace tessera {

/// Immutable and thread safe. Keeps the grids alive.
class Emitter {
 public:
  /// Triangles that are not finite or have no area are left out.
  explicit Emitter(std::vector<std::shared_ptr<const Grid>> grids);

  bool empty() const { return triangles_.empty(); }
  /// Whether any of it moves while the shutter is open.
  bool moves() const;
  /// At shutter open, camera units: the centroid of the area, a box around it and the area itself.
  /// Of an empty emitter nothing is known.
  const LightExtent& extent() const { return extent_; }
  /// The place for xi in [0, 1)^2, evenly spread over the area at shutter open, where the surface
  /// is at shutter time `time` in [0, 1]; the normal is the outward one of the flat triangle. xi.x
  /// runs along a Hilbert curve over each grid, so that values well spread there are so on the
  /// surface. Deforming surfaces shine as much from a part that grows as before.
  LightPlace place(glm::vec2 xi, float time) const;

 private:
  struct Triangle {
    uint32_t grid, triangle;
  };
  void add_triangle(uint32_t grid, uint32_t triangle);
  std::array<glm::vec3, 3> corners(size_t triangle, float time) const;
  glm::dvec3 centroid() const;
  /// How far the surfaces reach from `centre` along each of three unit vectors.
  glm::dvec3 reach(const glm::dvec3& centre, const std::array<glm::dvec3, 3>& frame) const;
  /// Fills the extent; of two boxes, along the first triangle and along the camera's axes, the one
  /// with the smaller surface.
  void measure();

  std::vector<std::shared_ptr<const Grid>> grids_;
  std::vector<Triangle> triangles_;
  std::vector<double> area_up_to_;  ///< [triangle] area of it and all before, camera units squared
  LightExtent extent_;
};

/// Gives area light number `index` of the scene the grids that are part of it. Throws Error, with
/// the place of the light in the scene file, where they have no area.
void make_emitter(std::span<const std::shared_ptr<const Grid>> grids, int index, BoundLight& light);

}  // namespace tessera
