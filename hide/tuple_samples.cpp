#include "hide/tuple_samples.h"

#include <limits>

#include "base/error.h"

namespace tessera {

size_t TupleSamples::cell_of(size_t pixel) const {
  const int width = rect_.width(), x = int(pixel) % width, y = int(pixel) / width;
  const int column = ((rect_.x0 + x) >> cell_shift_) - (rect_.x0 >> cell_shift_);
  const int row = ((rect_.y0 + y) >> cell_shift_) - (rect_.y0 >> cell_shift_);
  return size_t(row) * size_t(columns_) + size_t(column);
}

void TupleSamples::arrange(const SampleBlock& block, size_t tuple_count, int cell_shift) {
  rect_ = block.rect, cell_shift_ = cell_shift;
  columns_ = rect_.empty() ? 0 : ((rect_.x1 - 1) >> cell_shift) - (rect_.x0 >> cell_shift) + 1;
  rows_ = rect_.empty() ? 0 : ((rect_.y1 - 1) >> cell_shift) - (rect_.y0 >> cell_shift) + 1;
  points_.assign(tuple_count, {});
  count_cells(block, tuple_count);
  place_samples(block);
}

/// Leaves the first place of cell c at start_[c + 1].
void TupleSamples::count_cells(const SampleBlock& block, size_t tuple_count) {
  const size_t cells = size_t(columns_) * size_t(rows_), spp = size_t(block.samples_per_pixel);
  if (block.tuple.size() < block.size())
    throw Error("the samples lie on no tuples; expected a pattern made for this hider");
  start_.assign(tuple_count * cells + 2, 0);
  for (size_t i = 0, pixel = 0; i < block.size(); ++pixel) {
    const size_t cell = cell_of(pixel);
    for (size_t k = 0; k < spp; ++k, ++i) {
      if (block.tuple[i] >= tuple_count)
        throw Error(fmt::format("a sample is on tuple {}; expected {} tuples", block.tuple[i],
                                tuple_count));
      ++start_[block.tuple[i] * cells + cell + 2];
    }
  }
  for (size_t c = 1; c < start_.size(); ++c) start_[c] += start_[c - 1];
}

/// Moves start_[c + 1] on to the end of cell c, which is where the next one begins.
void TupleSamples::place_samples(const SampleBlock& block) {
  const size_t cells = size_t(columns_) * size_t(rows_), spp = size_t(block.samples_per_pixel);
  const size_t stored = padded(block.size()) + simd_padding;
  x_.resize(stored), y_.resize(stored);
  source_.resize(block.size());
  for (size_t i = 0, pixel = 0; i < block.size(); ++pixel) {
    const size_t cell = cell_of(pixel);
    for (size_t k = 0; k < spp; ++k, ++i) {
      const uint32_t place = start_[block.tuple[i] * cells + cell + 1]++;
      x_[place] = block.x[i], y_[place] = block.y[i];
      source_[place] = uint32_t(i);
    }
  }
  for (size_t i = block.size(); i < stored; ++i)
    x_[i] = y_[i] = std::numeric_limits<float>::quiet_NaN();
  for (size_t n = 0; n < points_.size(); ++n) {
    if (start_[n * cells] == start_[(n + 1) * cells]) continue;
    const uint32_t i = source_[start_[n * cells]];
    if (!block.u.empty()) points_[n].u = block.u[i], points_[n].v = block.v[i];
    if (!block.t.empty()) points_[n].t = block.t[i];
  }
}

}  // namespace tessera
