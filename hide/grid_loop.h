#pragma once
/// What hiders that take a bucket's grids one after the other have in common.

#include <algorithm>
#include <cmath>

#include "hide/clip_grid.h"
#include "hide/depth_margin.h"
#include "hide/fragment_buffer.h"
#include "hide/tile_depth.h"

namespace tessera {

/// What the loop keeps for a bucket; part of a hider's scratch space.
struct GridLoop {
  ClipGrid clip;  ///< of the grid at hand
  FragmentBuffer fragments;
  TileDepth depth;
};

/// Pixels that a grid may touch, relative to the first of `rect`.
inline PixelRect pixels_of(const Grid& grid, const PixelRect& rect) {
  const RasterBounds& r = grid.raster_bounds;
  const auto pixel = [](float position, int first, int size) {
    return int(std::clamp(position - float(first), 0.0f, float(size)));
  };
  return {pixel(r.x_min, rect.x0, rect.width()), pixel(r.y_min, rect.y0, rect.height()),
          std::min(pixel(r.x_max, rect.x0, rect.width()) + 1, rect.width()),
          std::min(pixel(r.y_max, rect.y0, rect.height()) + 1, rect.height())};
}

/// Hides the grids of a bucket, front to back, but those wholly behind what is known to be opaque:
/// hide_segment(g, segment, nearest) puts the hits of a segment of grid g, none of them nearer than
/// `nearest`, into loop.fragments and returns the number of micropolygons that it tested.
template <class HideSegment>
void hide_grids(const HideInput& input, GridLoop& loop, FragmentList& out, HideCounters& counters,
                const HideSegment& hide_segment) {
  const PixelRect& rect = input.samples->rect;
  const PixelRect everywhere{0, 0, rect.width(), rect.height()};
  loop.fragments.begin(input);
  loop.depth.begin(rect, input.samples->samples_per_pixel);
  for (size_t g = 0; g < input.grids.size(); ++g) {
    const Grid& grid = *input.grids[g].grid;
    loop.clip.set(grid, input.raster_clip);
    const auto count = uint64_t(grid.micropolygon_count());
    counters.micropolygons += count;
    counters.nonfinite_dropped += loop.clip.dropped_count();
    const float size = std::max(std::abs(loop.clip.z_min()), std::abs(loop.clip.z_max()));
    const float nearest = loop.clip.z_min() - depth_margin * size;
    uint64_t tested = 0;
    if (nearest <= loop.depth.farthest(everywhere)) {
      for (const ClipSegment& segment : loop.clip.segments())
        tested += hide_segment(g, segment, nearest);
      // Nobody asks after the last grid.
      if (input.grids[g].opaque && g + 1 < input.grids.size())
        loop.depth.update(pixels_of(grid, rect), loop.fragments);
    }
    counters.micropolygons_culled += count - std::min(tested, count);
  }
  loop.fragments.resolve(input, out);
  counters.samples += input.samples->size();
  counters.fragments += out.size();
}

}  // namespace tessera
