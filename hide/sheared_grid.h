#pragma once
/// A block of a grid that moves or is seen through an open lens, hidden in the space of its shear
/// map: candidate samples are carried back to the reference time and the lens centre, sorted into
/// small cells there, and tested by the micropolygons that stand on these cells.

#include <vector>

#include "hide/blurred_grid.h"
#include "hide/shear_map.h"

namespace tessera {

/// Bound on the rounding of the sample test, of the map and of the places of the vertices, relative
/// to |X| + |u coc| + |x W| as in hide/block_bounds.h: the test takes 15 units of 2^-24, a vertex's
/// fields and what is left over about 20, the map of a sample about 40.
inline constexpr float shear_rounding_margin = 128 * 0x1p-24f;

/// A block in the space of its map, positions relative to the map's middle.
struct ShearedBlock {
  ShearMap map;
  AlignedVector<float> x_low, x_high, y_low, y_high;  ///< [vertex of the grid] where it may be met
  /// [x low, x high, y low, y high][row of the block * stride + column]: where samples that a
  /// micropolygon covers are mapped to.
  AlignedVector<float> boxes[4];
  size_t stride = 0;
  RasterBounds extent;  ///< of all boxes
  float slack = 0;      ///< the largest, pixels

  /// Makes room for the block of a grid.
  void begin(int u_count, const GridBlock& block);
};

/// Small rectangles that cover the extent of a block in the space of its map, row by row. Cells of
/// positions are monotonic in the position, rounding included.
struct CellLattice {
  float x_first = 0, y_first = 0;  ///< of cell (0, 0), relative to the map's middle
  float per_x = 1, per_y = 1;      ///< cells per pixel
  int columns = 1, rows = 1;
};

/// The candidates of a block, sorted by cell, and what they see.
struct CellSamples {
  /// As they were found: cell of each, once sorted its rank, and its index in the bucket.
  std::vector<uint32_t> cell, found;
  std::vector<uint32_t> end;  ///< [1 + cell]: end of its run; end[0] is 0, so end[c] begins cell c
  AlignedVector<float> x, y, u, v, t;  ///< sorted
  AlignedVector<uint32_t>
      index;  ///< in the bucket, sorted; not for opaque blocks unless tests are counted
  /// Nearest opaque hit of the block on each, sorted; an id of `no_hit` means none.
  AlignedVector<float> z, b1, b2;
  AlignedVector<uint32_t> id;
  size_t count = 0;

  static constexpr uint32_t no_hit = ~0u;
  /// Room for `capacity` candidates and a vector more.
  void reserve(size_t capacity);
  SampleArrays samples() const { return {x.data(), y.data(), u.data(), v.data(), t.data()}; }
};

struct ShearScratch {
  std::vector<ShearedBlock> blocks;  ///< [depth of splitting]
  CellSamples cells;
  std::vector<int32_t> boxes;  ///< of a row of micropolygons
};

struct ShearedGridJob {
  BlurredGridJob blur;  ///< for blocks that no map fits
  ShearScratch* scratch = nullptr;
};

/// Returns the number of micropolygons that were tested.
uint64_t hide_sheared_grid(const ShearedGridJob& job);

}  // namespace tessera
