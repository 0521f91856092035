#include "hide/boxed_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hide/depth_margin.h"
#include "hide/swept_box.h"

namespace tessera {
namespace {

/// Depth at which nothing of the micropolygon is nearer at any time of the segment.
float nearest_swept(const Quad& quad, bool moves) {
  if (!moves) return nearest_depth(quad.z);
  float end[4];
  for (int k = 0; k < 4; ++k) end[k] = quad.z[k] + quad.dz[k];
  return std::min(nearest_depth(quad.z), nearest_depth(end));
}

void count_tests(const PixelTestJob& test, const PixelRect& pixels) {
  for (int y = pixels.y0; y < pixels.y1; ++y)
    for (int x = pixels.x0; x < pixels.x1; ++x)
      test.tests_per_pixel[size_t(y) * test.pixels_per_row + size_t(x)] +=
          uint32_t(test.samples_per_pixel);
}

/// Corners on the raster at one end of a segment, with their blur.
struct RasterQuad {
  float x[4], y[4], x_blur[4], y_blur[4];
  bool in_front = true;
};

RasterQuad project(const HideInput& input, const Quad& q, bool at_end) {
  RasterQuad r;
  const float lens = input.features.lens ? input.lens_extent : 0.0f;
  for (int k = 0; k < 4; ++k) {
    const auto at = [&](const float* start, const float* delta) {
      return at_end ? start[k] + delta[k] : start[k];
    };
    const float W = at(q.W, q.dW), z = at(q.z, q.dz);
    r.in_front &= W > 0;
    r.x[k] = at(q.X, q.dX) / W, r.y[k] = at(q.Y, q.dY) / W;
    r.x_blur[k] = lens * std::abs(input.raster_clip.coc_x(z)) / W;
    r.y_blur[k] = lens * std::abs(input.raster_clip.coc_y(z)) / W;
  }
  return r;
}

float area(const RasterQuad& q) {
  return 0.5f *
         std::abs((q.x[3] - q.x[0]) * (q.y[2] - q.y[1]) - (q.x[2] - q.x[1]) * (q.y[3] - q.y[0]));
}

}  // namespace

uint64_t hide_boxed_grid(const BoxedGridJob& job) {
  const ClipGrid& clip = job.clip;
  const bool moves = job.segment.dX != nullptr, cull = job.depth.useful();
  const SweptRange range = whole_range(job.input);
  CoverageCounts counts;
  uint64_t tested = 0, micropolygons = 0;
  for (int j = 0; j < clip.v_count(); ++j)
    for (int i = 0; i < clip.u_count(); ++i) {
      const int m = j * clip.u_count() + i;
      if (clip.dropped(m)) continue;
      const Quad quad = load_quad(job.segment, clip.u_count(), i, j);
      const PixelRect pixels = SweptBox(job.input, quad, moves).pixels(range);
      if (pixels.empty()) continue;
      if (cull && nearest_swept(quad, moves) > job.depth.farthest(pixels)) continue;
      ++micropolygons;
      tested += uint64_t(pixels.pixel_count()) * job.test.samples_per_pixel;
      if (!job.test.tests_per_pixel.empty()) count_tests(job.test, pixels);
      test_pixel_rect(job.test, quad, job.id0 + 2 * uint32_t(m), pixels, counts);
    }
  job.counters.samples_tested += tested;
  job.counters.samples_covered += counts.covered;
  job.counters.nonfinite_dropped += counts.nonfinite;
  return micropolygons;
}

float swept_growth(const HideInput& input, const ClipGrid& clip, const ClipSegment& segment) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  const int u = clip.u_count() - 1, v = clip.v_count() - 1;
  const int places[5][2] = {{0, 0}, {u, 0}, {u / 2, v / 2}, {0, v}, {u, v}};
  float swept = 0, covered = 0;
  for (const auto& [i, j] : places) {
    const Quad quad = load_quad(segment, clip.u_count(), i, j);
    RasterBounds box;
    const int ends = segment.dX ? 2 : 1;
    for (int end = 0; end < ends; ++end) {
      const RasterQuad q = project(input, quad, end == 1);
      if (!q.in_front) return infinity;
      for (int k = 0; k < 4; ++k) {
        box.add(q.x[k] - q.x_blur[k], q.y[k] - q.y_blur[k]);
        box.add(q.x[k] + q.x_blur[k], q.y[k] + q.y_blur[k]);
      }
      covered += area(q) / float(ends);
    }
    // Boxes are whole pixels, on average one more along each side.
    swept += (box.x_max - box.x_min + 1) * (box.y_max - box.y_min + 1);
  }
  return covered > 0 ? swept / covered : infinity;
}

}  // namespace tessera
