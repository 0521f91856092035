#pragma once
/// A grid in raster clip space (cameras/camera.h), the space in which the hider works.

#include <cstdint>
#include <span>
#include <vector>

#include "base/aligned.h"
#include "cameras/camera.h"
#include "dice/grid.h"

namespace tessera {

/// Raster clip coordinates larger than this count as not finite: the square of such a number times
/// a raster coordinate still fits a float.
inline constexpr float largest_clip_coordinate = 1e17f;

/// The vertices between two motion keys. A vertex is at X + tau * dX (and so on) for
/// tau = (t - t_begin) * inverse_duration in [0, 1].
struct ClipSegment {
  float t_begin = 0, t_end = 1;  ///< owns samples t_begin <= t < t_end; the last, t <= t_end too
  float inverse_duration = 1;
  bool last = true;
  const float *X = nullptr, *Y = nullptr, *W = nullptr;                    ///< [vertex], at t_begin
  const float* z = nullptr;                                                ///< camera depth
  const float *dX = nullptr, *dY = nullptr, *dW = nullptr, *dz = nullptr;  ///< null if static
};

/// Reusable storage for one grid at a time. Every coordinate is a function of its vertex alone, so
/// grids that share vertices bit for bit share their clip coordinates too.
class ClipGrid {
 public:
  void set(const Grid& grid, const RasterClipMap& map);

  const Grid& grid() const { return *grid_; }
  int u_count() const { return grid_->u_count; }
  int v_count() const { return grid_->v_count; }
  bool moves() const { return grid_->key_count() > 1; }
  /// One if static; else those of positive duration, in time order.
  std::span<const ClipSegment> segments() const { return segments_; }
  /// Depth range over all keys.
  float z_min() const { return z_min_; }
  float z_max() const { return z_max_; }

  /// True if a corner of the micropolygon is not finite or too large at some key; no hider tests
  /// such a micropolygon. Its coordinates read as zero.
  bool dropped(int micropolygon) const {
    return !dropped_.empty() && dropped_[size_t(micropolygon)] != 0;
  }
  uint64_t dropped_count() const { return dropped_count_; }

 private:
  float* axis(int key, int k) { return keys_.data() + (size_t(key) * 4 + size_t(k)) * stride_; }
  /// Whether every coordinate of the key is usable.
  bool transform_key(int key, const RasterClipMap& map);
  void drop_unusable();
  void measure_depth();
  void make_segments();

  const Grid* grid_ = nullptr;
  size_t stride_ = 0;
  AlignedVector<float> keys_;    // [key][X, Y, W, z][vertex]
  AlignedVector<float> deltas_;  // [segment][dX, dY, dW, dz][vertex]
  std::vector<ClipSegment> segments_;
  std::vector<uint8_t> dropped_;  // [micropolygon]; empty if none is
  uint64_t dropped_count_ = 0;
  float z_min_ = 0, z_max_ = 0;
};

}  // namespace tessera
