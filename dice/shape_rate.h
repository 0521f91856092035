#pragma once
/// How finely curves and pieces are diced by their shape alone, wherever the camera is: by the
/// angle that they turn.

#include <span>

#include <glm/glm.hpp>

#include "dice/dice_rate.h"

namespace tessera {

/// The largest turn of rows of points over all keys, as RowSize is their largest length. One row
/// for a curve, all those along one parameter for a piece.
class ShapeTurn {
 public:
  /// A row at one key: how far the curve through it turns from its start to its end.
  void add_row(std::span<const glm::vec3> row_camera);
  /// How far the normal turns on the way along a row, where a second one lies beside it: what a
  /// surface does that is twisted between straight lines. Rows of equal length.
  void add_strip(std::span<const glm::vec3> row_camera, std::span<const glm::vec3> beside_camera);

  RowSegments segments(const ShapeRate& rate) const;

 private:
  /// `longest` of `pieces` turns that add up to `sum`. Uneven rows count for up to twice their sum.
  void add(double sum, double longest, int pieces);

  double turn_radians_ = 0;
};

}  // namespace tessera
