#pragma once
/// The farthest opaque depth in each tile of a bucket: what lies behind it everywhere in the tile
/// cannot be seen.

#include <vector>

#include "hide/fragment_buffer.h"

namespace tessera {

/// Largest of `count` depths. Reads whole vectors, and only those; `count` may be any number.
float farthest_depth(const float* z, size_t count);

class TileDepth {
 public:
  static constexpr int tile = 8;  ///< pixels

  void begin(const PixelRect& rect, int samples_per_pixel);
  /// Takes up the depths of the tiles that meet `pixels`, relative to the bucket's first.
  void update(const PixelRect& pixels, const FragmentBuffer& buffer);
  /// Farthest opaque depth over the tiles that meet `pixels`; infinity where a sample sees nothing
  /// opaque yet.
  float farthest(const PixelRect& pixels) const;
  /// False while every tile has a sample that sees nothing opaque, so that nothing can be culled.
  bool useful() const { return useful_; }

 private:
  PixelRect tiles_of(const PixelRect& pixels) const;

  int width_ = 0, height_ = 0, columns_ = 0;
  size_t samples_per_pixel_ = 0;
  bool useful_ = false;
  std::vector<float> depth_;
};

}  // namespace tessera
