/// The brute-force hider: every sample in a box around all that a micropolygon sweeps over the
/// shutter and the lens is tested. It culls nothing by depth and shares no bounds with the faster
/// hiders, so that it can be their oracle.

#include "base/error.h"
#include "hide/hide.h"
#include "hide/pixel_test_job.h"
#include "hide/swept_box.h"

namespace tessera {
namespace {

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
    const SweptRange range = whole_range(input);
    CoverageCounts counts;
    for (int j = 0; j < clip.v_count(); ++j)
      for (int i = 0; i < clip.u_count(); ++i) {
        const int m = j * clip.u_count() + i;
        if (clip.dropped(m)) continue;
        const Quad quad = load_quad(segment, clip.u_count(), i, j);
        const PixelRect pixels = SweptBox(input, quad, segment.dX != nullptr).pixels(range);
        if (pixels.empty()) continue;
        counters.samples_tested += uint64_t(pixels.pixel_count()) * job.samples_per_pixel;
        test_pixel_rect(job, quad, fragments.ids().id(g, 2 * uint32_t(m)), pixels, counts);
        if (!input.tests_per_pixel.empty()) count_tests(input, pixels);
      }
    counters.samples_covered += counts.covered;
    counters.nonfinite_dropped += counts.nonfinite;
  }

  static void count_tests(const HideInput& input, const PixelRect& pixels) {
    const size_t row = size_t(input.samples->rect.width());
    for (int y = pixels.y0; y < pixels.y1; ++y)
      for (int x = pixels.x0; x < pixels.x1; ++x)
        input.tests_per_pixel[size_t(y) * row + size_t(x)] +=
            uint32_t(input.samples->samples_per_pixel);
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
