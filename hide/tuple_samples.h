#pragma once
/// The samples of a bucket sorted by tuple (hide/samples.h), and by place on the raster within
/// each, so that a 2D rasterisation of one tuple meets its samples side by side.

#include <span>
#include <vector>

#include "hide/samples.h"

namespace tessera {

/// Reusable. A cell is a pixel, or a tile of 2 x 2 pixels that starts at even raster coordinates;
/// tiles that the bucket cuts hold the samples of their pixels inside. Cells are counted from the
/// one of the bucket's first pixel.
class TupleSamples {
 public:
  /// Lens position and time; zero what the samples do not have.
  struct Point {
    float u = 0, v = 0, t = 0;
  };

  /// `cell_shift`: binary logarithm of a cell's side in pixels. Throws Error if the samples are not
  /// on `tuple_count` tuples. The block must outlive the use of this.
  void arrange(const SampleBlock& block, size_t tuple_count, int cell_shift);

  size_t tuple_count() const { return points_.size(); }
  const Point& point(size_t tuple) const { return points_[tuple]; }
  int cell_shift() const { return cell_shift_; }
  const PixelRect& rect() const { return rect_; }
  int columns() const { return columns_; }
  int rows() const { return rows_; }

  /// Place of the first sample of the cell in the arrays below. The samples of cells [a, b) of a
  /// row are at begin(tuple, row, a) up to begin(tuple, row, b), with b <= columns(); rows and
  /// tuples follow one another.
  size_t begin(size_t tuple, int row, int column) const {
    return start_[(tuple * size_t(rows_) + size_t(row)) * size_t(columns_) + size_t(column)];
  }
  size_t tuple_begin(size_t tuple) const { return begin(tuple, 0, 0); }

  /// [place], readable to a whole vector past the last. Raster position, pixels.
  const float* x() const { return x_.data(); }
  const float* y() const { return y_.data(); }
  /// [place] index into the block.
  std::span<const uint32_t> source() const { return source_; }

 private:
  void count_cells(const SampleBlock& block, size_t tuple_count);
  void place_samples(const SampleBlock& block);
  size_t cell_of(size_t pixel) const;

  PixelRect rect_;
  int cell_shift_ = 0, columns_ = 0, rows_ = 0;
  std::vector<Point> points_;     // [tuple]
  std::vector<uint32_t> start_;   // [tuple][row][column], the end of the last, and one more
  std::vector<uint32_t> source_;  // [place]
  AlignedVector<float> x_, y_;
};

}  // namespace tessera
