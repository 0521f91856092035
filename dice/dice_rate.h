#pragma once
/// How finely curves and pieces are diced: their size on the raster against the size that a
/// micropolygon may have, which grows with blur.

#include <optional>
#include <span>

#include "dice/least_blur.h"
#include "dice/projection.h"

namespace tessera {

/// Size of a row of points.
struct RowLength {
  float sum = 0;      ///< pixels, polyline through the samples
  float longest = 0;  ///< pixels, longest piece
  void add(float length) {
    sum += length;
    longest = longest < length ? length : longest;
  }
};

/// The largest size of rows of points over all keys. One row for a curve, all those along one
/// parameter for a piece.
struct RowSize {
  float length = 0;  ///< pixels, but never more than twice what an even parameter would need
  float most = 0;    ///< pixels a whole row would have where the parameter runs fastest
  float bend = 0;    ///< pixels from the chord of two neighbouring pieces to the vertex between
  int pieces = 1;    ///< samples less one

  /// A row at one key, from the distances between its samples.
  void add(const RowLength& row);
  /// Three samples in a row. The deviation counts as if it were seen squarely: the outline is where
  /// curves turn back on the raster, and show none.
  void add_bend(const RasterProjection& projection, const glm::vec3& a, const glm::vec3& b,
                const glm::vec3& c);
};

/// Size in pixels that a micropolygon's side may have.
struct DiceStep {
  float full = 1;     ///< at full rate
  float blurred = 1;  ///< at least `full`
  float sag = 0;      ///< pixels that a blurred side may deviate from its curve

  bool is_coarse() const { return blurred > full; }
};

/// Micropolygons along rows; `most` where the parameter runs fastest.
struct RowSegments {
  int count = 1, most = 1;
};
RowSegments segments_of(const RowSize& size, const DiceStep& step);

/// Dicing by shape, whatever is seen of it (dice/shape_rate.h).
struct ShapeRate {
  float turn_radians = 0.1f;  ///< that a micropolygon may turn along u or v
  int least_segments = 1;     ///< of every curve and piece, at most DiceRate::max_grid_size
};

/// What sizes are measured with.
struct DiceRate {
  const RasterProjection* projection = nullptr;
  std::span<const float> key_times;  ///< of the surface, from 0 to 1; one when it is static
  float step = 1;                    ///< pixels between vertices, without blur
  /// GeometricApproximation: blur of 16 pixels over the factor leaves the area of a micropolygon
  /// as it is, more of it lets it grow in proportion. 0: never.
  float motion_factor = 0, focus_factor = 0;
  int max_grid_size = 32;          ///< micropolygons along u and v
  std::optional<ShapeRate> shape;  ///< if given, sizes on the raster and blur mean nothing
  /// Pieces are not split below this parameter width, whatever their size.
  static constexpr double min_width = 1.0 / 4096;

  int key_count() const { return int(key_times.size()); }
  bool follows_blur() const { return motion_factor > 0 || focus_factor > 0; }
  DiceStep step_under(const LeastBlur& blur) const;
};

}  // namespace tessera
