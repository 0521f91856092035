#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hide/clip_grid.cpp"
#include <algorithm>
#include <cmath>
#include <limits>

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "hide/clip_grid.h"

#ifndef TESSERA_HIDE_KEY_JOB
#define TESSERA_HIDE_KEY_JOB
namespace tessera {
/// The vertices of one motion key: camera space in, raster clip space and camera depth out.
struct KeyJob {
  const float *x, *y, *z;
  float *X, *Y, *W, *depth;
  size_t count;  ///< a multiple of a vector
};
/// Over the vertices of a key.
struct KeyExtremes {
  float z_min, z_max;
  bool usable;  ///< no coordinate is too large or not a number
};
}  // namespace tessera
#endif

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Every coordinate is rounded after each product, as scalar code does without contraction, so that
/// all targets see the same vertices.
KeyExtremes transform(const KeyJob& job, const RasterClipMap& map) {
  const hn::ScalableTag<float> d;
  const auto set = [&](float value) HWY_ATTR { return hn::Set(d, value); };
  auto low = set(std::numeric_limits<float>::infinity()), high = hn::Neg(low);
  auto usable = hn::Eq(low, low);
  const auto limit = set(largest_clip_coordinate);
  for (size_t i = 0; i < job.count; i += hn::Lanes(d)) {
    const auto z = hn::Load(d, job.z + i);
    const auto W = hn::Add(hn::Mul(set(map.w_from_z), z), set(map.w_constant));
    const auto X =
        hn::Add(hn::Mul(set(map.x_scale), hn::Load(d, job.x + i)), hn::Mul(set(map.x_from_w), W));
    const auto Y =
        hn::Add(hn::Mul(set(map.y_scale), hn::Load(d, job.y + i)), hn::Mul(set(map.y_from_w), W));
    hn::StoreU(X, d, job.X + i), hn::StoreU(Y, d, job.Y + i);
    hn::StoreU(W, d, job.W + i), hn::StoreU(z, d, job.depth + i);
    low = hn::Min(low, z), high = hn::Max(high, z);
    for (const auto v : {X, Y, W, z}) usable = hn::And(usable, hn::Le(hn::Abs(v), limit));
  }
  return {hn::GetLane(hn::MinOfLanes(d, low)), hn::GetLane(hn::MaxOfLanes(d, high)),
          hn::AllTrue(d, usable)};
}

/// to = after - before, `count` a multiple of a vector.
void subtract(const float* after, const float* before, float* to, size_t count) {
  const hn::ScalableTag<float> d;
  for (size_t i = 0; i < count; i += hn::Lanes(d))
    hn::StoreU(hn::Sub(hn::LoadU(d, after + i), hn::LoadU(d, before + i)), d, to + i);
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tessera {

HWY_EXPORT(transform);
HWY_EXPORT(subtract);

void ClipGrid::set(const Grid& grid, const RasterClipMap& map) {
  grid_ = &grid;
  stride_ = grid.stride();
  // A vector more at the end: kernels read whole vectors from any vertex.
  keys_.resize(size_t(grid.key_count()) * 4 * stride_ + simd_padding);
  z_min_ = std::numeric_limits<float>::infinity(), z_max_ = -z_min_;
  bool usable = true;
  for (int key = 0; key < grid.key_count(); ++key) usable &= transform_key(key, map);
  dropped_.clear();
  dropped_count_ = 0;
  if (!usable) drop_unusable();
  make_segments();
}

bool ClipGrid::transform_key(int key, const RasterClipMap& map) {
  const size_t count = size_t(grid_->vertex_count());
  // Whole vectors first, then the rest one by one: what pads the grid's arrays may be anything.
  const size_t whole = count / simd_padding * simd_padding;
  const float *x = grid_->P(key, 0), *y = grid_->P(key, 1), *z = grid_->P(key, 2);
  float *X = axis(key, 0), *Y = axis(key, 1), *W = axis(key, 2), *depth = axis(key, 3);
  KeyExtremes e = HWY_DYNAMIC_DISPATCH(transform)({x, y, z, X, Y, W, depth, whole}, map);
  for (size_t i = whole; i < count; ++i) {
    const float w = map.w_from_z * z[i] + map.w_constant;
    X[i] = map.x_scale * x[i] + map.x_from_w * w;
    Y[i] = map.y_scale * y[i] + map.y_from_w * w;
    W[i] = w, depth[i] = z[i];
    e.z_min = std::min(e.z_min, z[i]), e.z_max = std::max(e.z_max, z[i]);
    for (const float v : {X[i], Y[i], W[i], z[i]})
      e.usable &= std::abs(v) <= largest_clip_coordinate;
  }
  // The padding repeats a vertex, so that whole-vector reads meet nothing odd.
  for (int k = 0; k < 4; ++k)
    std::fill(axis(key, k) + count, axis(key, k) + stride_, axis(key, k)[0]);
  z_min_ = std::min(z_min_, e.z_min), z_max_ = std::max(z_max_, e.z_max);
  return e.usable;
}

void ClipGrid::drop_unusable() {
  // NaN fails every comparison, so it is found by what is not within the limit.
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
  measure_depth();
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
  HWY_DYNAMIC_DISPATCH(subtract)
  (keys_.data() + step, keys_.data(), deltas_.data(), size_t(count) * step);
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
#endif
