#pragma once
/// The surfaces of an area light as parallelograms and triangles, from which places are drawn in
/// proportion to area.

#include <memory>
#include <span>
#include <vector>

#include "dice/grid.h"
#include "shade/extended_light.h"

namespace tessera {

/// Immutable and thread safe. Keeps the grids alive.
class Emitter {
 public:
  /// Pieces that are not finite or have no area are left out.
  explicit Emitter(std::vector<std::shared_ptr<const Grid>> grids);

  bool empty() const { return pieces_.empty(); }
  /// Whether any of it moves while the shutter is open.
  bool moves() const;
  /// At shutter open, camera units: the centroid of the area, a box around it and the area itself.
  /// Of an empty emitter nothing is known.
  const LightExtent& extent() const { return extent_; }
  /// The place for xi in [0, 1)^2, evenly spread over the area at shutter open, where the surface
  /// is at shutter time `time` in [0, 1]; the normal is the outward one of the flat piece. xi.x
  /// picks a grid and a column, xi.y a row, so that what is well spread over the square is so on
  /// each grid; on a single parallelogram places are spread as xi is. Deforming surfaces shine as
  /// much from a part that grows as before.
  LightPlace place(glm::vec2 xi, float time) const;

 private:
  /// A triangle, or the parallelogram that it is half of where a grid is no more than that.
  struct Piece {
    uint32_t grid, triangle;
    bool parallelogram;
  };
  void add_grid(uint32_t grid);
  void add_micropolygon(uint32_t grid, uint32_t micropolygon);
  void add(const Piece& piece);
  double area_before(size_t piece) const { return piece > 0 ? area_up_to_[piece - 1] : 0.0; }
  double area_before_row(size_t row) const { return area_before(row > 0 ? row_ends_[row - 1] : 0); }
  double area_before_grid(size_t grid) const {
    return area_before_row(grid > 0 ? grid_ends_[grid - 1] : 0);
  }
  /// a, b and c; of a parallelogram b and c are its corners next to a.
  std::array<glm::vec3, 3> corners(const Piece& piece, float time) const;
  glm::dvec3 centroid() const;
  /// How far the surfaces reach from `centre` along each of three unit vectors.
  glm::dvec3 reach(const glm::dvec3& centre, const std::array<glm::dvec3, 3>& frame) const;
  /// Fills the extent; of two boxes, along the first piece and along the camera's axes, the one
  /// with the smaller surface.
  void measure();

  std::vector<std::shared_ptr<const Grid>> grids_;
  std::vector<Piece> pieces_;
  std::vector<double> area_up_to_;  ///< [piece] area of it and all before, camera units squared
  std::vector<size_t> row_ends_;    ///< [row of a grid with any piece] the first piece after it
  std::vector<size_t> grid_ends_;   ///< [grid with any piece] the first row after it
  LightExtent extent_;
};

/// Gives area light number `index` of the scene the grids that are part of it. Throws Error, with
/// the place of the light in the scene file, where they have no area.
void make_emitter(std::span<const std::shared_ptr<const Grid>> grids, int index, BoundLight& light);

}  // namespace tessera
