#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hide/tile_depth.cpp"
#include <algorithm>
#include <limits>

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "hide/tile_depth.h"

HWY_BEFORE_NAMESPACE();
namespace tessera {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

float farthest(const float* z, size_t count) {
  const hn::ScalableTag<float> d;
  const size_t lanes = hn::Lanes(d);
  auto most = hn::Set(d, -hwy::HighestValue<float>());
  size_t i = 0;
  for (; i + lanes <= count; i += lanes) most = hn::Max(most, hn::LoadU(d, z + i));
  float result = hn::GetLane(hn::MaxOfLanes(d, most));
  for (; i < count; ++i) result = z[i] > result ? z[i] : result;
  return result;
}

}  // namespace HWY_NAMESPACE
}  // namespace tessera
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tessera {

HWY_EXPORT(farthest);

float farthest_depth(const float* z, size_t count) {
  return HWY_DYNAMIC_DISPATCH(farthest)(z, count);
}

void TileDepth::begin(const PixelRect& rect, int samples_per_pixel) {
  width_ = rect.width(), height_ = rect.height();
  columns_ = (width_ + tile - 1) / tile;
  samples_per_pixel_ = size_t(samples_per_pixel);
  useful_ = false;
  depth_.assign(size_t(columns_) * size_t((height_ + tile - 1) / tile),
                std::numeric_limits<float>::infinity());
}

PixelRect TileDepth::tiles_of(const PixelRect& pixels) const {
  return {pixels.x0 / tile, pixels.y0 / tile, (pixels.x1 + tile - 1) / tile,
          (pixels.y1 + tile - 1) / tile};
}

void TileDepth::update(const PixelRect& pixels, const FragmentBuffer& buffer) {
  const PixelRect tiles = tiles_of(pixels);
  for (int j = tiles.y0; j < tiles.y1; ++j)
    for (int i = tiles.x0; i < tiles.x1; ++i) {
      const int x0 = i * tile, x1 = std::min(x0 + tile, width_);
      float most = 0.0f - std::numeric_limits<float>::max();
      for (int y = j * tile; y < std::min((j + 1) * tile, height_); ++y) {
        const size_t first = (size_t(y) * size_t(width_) + size_t(x0)) * samples_per_pixel_;
        most = std::max(most,
                        farthest_depth(buffer.z() + first, size_t(x1 - x0) * samples_per_pixel_));
        if (most == std::numeric_limits<float>::infinity()) break;
      }
      depth_[size_t(j * columns_ + i)] = most;
      useful_ |= most < std::numeric_limits<float>::infinity();
    }
}

float TileDepth::farthest(const PixelRect& pixels) const {
  const PixelRect tiles = tiles_of(pixels);
  float most = -std::numeric_limits<float>::max();
  for (int j = tiles.y0; j < tiles.y1; ++j)
    for (int i = tiles.x0; i < tiles.x1; ++i)
      most = std::max(most, depth_[size_t(j * columns_ + i)]);
  return most;
}

}  // namespace tessera
#endif
