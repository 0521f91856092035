#include "hide/clip_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tessera {

void ClipGrid::set(const Grid& grid, const RasterClipMap& map) {
  grid_ = &grid;
  stride_ = grid.stride();
  // A vector more at the end: kernels read whole vectors from any vertex.
  keys_.resize(size_t(grid.key_count()) * 4 * stride_ + simd_padding);
  for (int key = 0; key < grid.key_count(); ++key) transform_key(key, map);
  drop_unusable();
  measure_depth();
  make_segments();
}

void ClipGrid::transform_key(int key, const RasterClipMap& map) {
  const float *x = grid_->P(key, 0), *y = grid_->P(key, 1), *z = grid_->P(key, 2);
  float *X = axis(key, 0), *Y = axis(key, 1), *W = axis(key, 2), *depth = axis(key, 3);
  const int count = grid_->vertex_count();
  for (int i = 0; i < count; ++i) {
    const float w = map.w_from_z * z[i] + map.w_constant;
    X[i] = map.x_scale * x[i] + map.x_from_w * w;
    Y[i] = map.y_scale * y[i] + map.y_from_w * w;
    W[i] = w;
    depth[i] = z[i];
  }
  // The padding repeats a vertex, so that whole-vector reads meet nothing odd.
  for (int k = 0; k < 4; ++k)
    std::fill(axis(key, k) + count, axis(key, k) + stride_, axis(key, k)[0]);
}

void ClipGrid::drop_unusable() {
  dropped_.clear();
  dropped_count_ = 0;
  // NaN fails every comparison, so it is found by what is not within the limit.
  const size_t values = size_t(grid_->key_count()) * 4 * stride_;
  size_t usable = 0;
  for (size_t i = 0; i < values; ++i) usable += std::abs(keys_[i]) <= largest_clip_coordinate;
  if (usable == values) return;

  const int count = grid_->vertex_count(), row = grid_->u_count + 1;
  std::vector<uint8_t> bad(stride_, 0);
  for (size_t a = 0; a < size_t(grid_->key_count()) * 4; ++a)
    for (int i = 0; i < count; ++i)
      bad[size_t(i)] |= !(std::abs(keys_[a * stride_ + size_t(i)]) <= largest_clip_coordinate);
  for (size_t a = 0; a < size_t(grid_->key_count()) * 4; ++a)
    for (size_t i = 0; i < stride_; ++i)
      if (bad[i < size_t(count) ? i : 0]) keys_[a * stride_ + i] = 0.0f;

  dropped_.resize(size_t(grid_->micropolygon_count()));
  for (int j = 0; j < grid_->v_count; ++j)
    for (int i = 0; i < grid_->u_count; ++i) {
      const size_t a = size_t(j * row + i), c = a + size_t(row);
      const uint8_t drop = bad[a] | bad[a + 1] | bad[c] | bad[c + 1];
      dropped_[size_t(j * grid_->u_count + i)] = drop;
      dropped_count_ += drop;
    }
}

void ClipGrid::measure_depth() {
  z_min_ = std::numeric_limits<float>::infinity(), z_max_ = -z_min_;
  for (int key = 0; key < grid_->key_count(); ++key) {
    const auto [low, high] =
        std::minmax_element(axis(key, 3), axis(key, 3) + grid_->vertex_count());
    z_min_ = std::min(z_min_, *low), z_max_ = std::max(z_max_, *high);
  }
}

void ClipGrid::make_segments() {
  const int count = grid_->key_count() - 1;
  segments_.clear();
  if (count <= 0) {
    ClipSegment& s = segments_.emplace_back();
    s.X = axis(0, 0), s.Y = axis(0, 1), s.W = axis(0, 2), s.z = axis(0, 3);
    return;
  }
  deltas_.resize(size_t(count) * 4 * stride_ + simd_padding);
  const size_t step = 4 * stride_;
  for (size_t i = 0; i < size_t(count) * step; ++i) deltas_[i] = keys_[i + step] - keys_[i];
  for (int k = 0; k < count; ++k) {
    const float begin = grid_->key_times[size_t(k)], end = grid_->key_times[size_t(k) + 1];
    if (!(end > begin)) continue;
    const float* delta = deltas_.data() + size_t(k) * step;
    segments_.push_back({begin, end, 1.0f / (end - begin), false, axis(k, 0), axis(k, 1),
                         axis(k, 2), axis(k, 3), delta, delta + stride_, delta + 2 * stride_,
                         delta + 3 * stride_});
  }
  if (!segments_.empty()) segments_.back().last = true;
}

}  // namespace tessera
