/// The brute-force hider: every sample in a box around all that a micropolygon sweeps over the
/// shutter and the lens is tested. It culls nothing by depth and shares no bounds with the faster
/// hiders, so that it can be their oracle.

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "hide/hide.h"
#include "hide/pixel_test_job.h"

namespace tessera {
namespace {

struct Interval {
  double min = INFINITY, max = -INFINITY;
  void add(double value) { min = std::min(min, value), max = std::max(max, value); }
};

/// Pixels of [0, size) that [min, max], relative to pixel 0, may touch; the test is written so that
/// a NaN keeps them all.
void clamp_pixels(double min, double max, int size, int& first, int& end) {
  first = min > 0 ? int(std::min(std::floor(min), double(size))) : 0;
  end = max < size ? int(std::max(0.0, std::floor(max) + 1.0)) : size;
}

class BboxHider final : public Hider {
 public:
  class Buffers final : public Scratch {
   public:
    ClipGrid clip;
    FragmentBuffer fragments;
  };

  std::unique_ptr<Scratch> make_scratch() const override { return std::make_unique<Buffers>(); }

  void hide(const HideInput& input, Scratch& scratch, FragmentList& out,
            HideCounters& counters) const override {
    auto& [clip, fragments] = static_cast<Buffers&>(scratch);
    fragments.begin(input);
    for (size_t g = 0; g < input.grids.size(); ++g) {
      clip.set(*input.grids[g].grid, input.raster_clip);
      counters.micropolygons += uint64_t(clip.grid().micropolygon_count());
      counters.nonfinite_dropped += clip.dropped_count();
      for (const ClipSegment& segment : clip.segments())
        hide_segment(input, clip, segment, g, fragments, counters);
    }
    fragments.resolve(input, out);
    counters.samples += input.samples->size();
    counters.fragments += out.size();
  }

 private:
  static void hide_segment(const HideInput& input, const ClipGrid& clip, const ClipSegment& segment,
                           size_t g, FragmentBuffer& fragments, HideCounters& counters) {
    const PixelTestJob job = pixel_test_job(input, clip, segment, input.grids[g].opaque, fragments);
    CoverageCounts counts;
    for (int j = 0; j < clip.v_count(); ++j)
      for (int i = 0; i < clip.u_count(); ++i) {
        const int m = j * clip.u_count() + i;
        if (clip.dropped(m)) continue;
        const Quad quad = load_quad(segment, clip.u_count(), i, j);
        const PixelRect pixels = swept_pixels(input, quad, segment.dX != nullptr);
        if (pixels.empty()) continue;
        counters.samples_tested += uint64_t(pixels.pixel_count()) * job.samples_per_pixel;
        if (!input.tests_per_pixel.empty()) count_tests(input, pixels);
        test_pixel_rect(job, quad, fragments.ids().id(g, 2 * uint32_t(m)), pixels, counts);
      }
    counters.samples_covered += counts.covered;
    counters.nonfinite_dropped += counts.nonfinite;
  }

  static void count_tests(const HideInput& input, const PixelRect& pixels) {
    const int width = input.samples->rect.width();
    for (int y = pixels.y0; y < pixels.y1; ++y)
      for (int x = pixels.x0; x < pixels.x1; ++x)
        input.tests_per_pixel[size_t(y * width + x)] += uint32_t(input.samples->samples_per_pixel);
  }

  /// Pixels, relative to the bucket's first, that the micropolygon may touch at any time and lens
  /// position. A corner in front of the eye moves monotonically on screen between two keys (linear
  /// motion projects to a fraction of two linear functions of time), and linearly over the lens, so
  /// the extremes are at the keys and at the edges of the lens. A corner at or behind the eye: all.
  ///
  /// The test rounds dx by less than 2^-18 of |X| + |x W| + |u coc| (docs/visibility.md counts the
  /// operations), which on screen is that over the smallest W.
  static PixelRect swept_pixels(const HideInput& input, const Quad& q, bool moves) {
    const PixelRect& rect = input.samples->rect;
    Interval x, y;
    double w_min = INFINITY, x_size = 0, y_size = 0, w_max = 0;
    for (int end = 0; end <= int(moves); ++end)
      for (int k = 0; k < 4; ++k) {
        const auto at = [&](const float* start, const float* delta) {
          return double(start[k]) + (end ? double(delta[k]) : 0.0);
        };
        const double X = at(q.X, q.dX), Y = at(q.Y, q.dY), W = at(q.W, q.dW), z = at(q.z, q.dz);
        const double E = input.features.lens ? double(input.lens_extent) : 0.0;
        const auto& [coc_x, coc_y] = std::pair(input.raster_clip.coc_x, input.raster_clip.coc_y);
        const double cx = E * (std::abs(coc_x.scale * z) + std::abs(coc_x.offset));
        const double cy = E * (std::abs(coc_y.scale * z) + std::abs(coc_y.offset));
        const double sx = E * (coc_x.scale * z + coc_x.offset);
        const double sy = E * (coc_y.scale * z + coc_y.offset);
        x.add((X - sx) / W), x.add((X + sx) / W), y.add((Y - sy) / W), y.add((Y + sy) / W);
        w_min = std::min(w_min, W), w_max = std::max(w_max, std::abs(W));
        x_size = std::max(x_size, std::abs(X) + cx), y_size = std::max(y_size, std::abs(Y) + cy);
      }
    if (!(w_min > 0)) return {0, 0, rect.width(), rect.height()};
    const double error = std::ldexp(1.0, -18) / w_min;
    const double x_pad = error * (x_size + std::max(std::abs(rect.x0), std::abs(rect.x1)) * w_max);
    const double y_pad = error * (y_size + std::max(std::abs(rect.y0), std::abs(rect.y1)) * w_max);
    PixelRect r;
    clamp_pixels(x.min - x_pad - rect.x0, x.max + x_pad - rect.x0, rect.width(), r.x0, r.x1);
    clamp_pixels(y.min - y_pad - rect.y0, y.max + y_pad - rect.y0, rect.height(), r.y0, r.y1);
    return r;
  }
};

}  // namespace

HiderDefinition hider_bbox() {
  return {
      "bbox", "tests every sample in the box a micropolygon sweeps; slow, the oracle",
      [](std::string_view arguments) -> std::unique_ptr<Hider> {
        if (!arguments.empty())
          throw Error(fmt::format("hider bbox: found arguments \"{}\"; expected none", arguments));
        return std::make_unique<BboxHider>();
      }};
}

}  // namespace tessera
