/// The method of Laine et al. 2011 as published, one micropolygon at a time: the baseline that the
/// sheared bounds are compared with. Grids behind what is known to be opaque are skipped whole;
/// nothing else is culled by depth, so that its counts compare with those of bbox and pixar.

#include <algorithm>
#include <charconv>

#include "base/error.h"
#include "hide/depth_margin.h"
#include "hide/dual_grid.h"
#include "hide/hide.h"
#include "hide/tile_depth.h"

namespace tessera {
namespace {

class DualHider final : public Hider {
 public:
  explicit DualHider(int tile_size) : tile_size_(tile_size) {}

  class Buffers final : public Scratch {
   public:
    ClipGrid clip;
    FragmentBuffer fragments;
    TileDepth depth;
    DualScratch dual;
  };

  std::unique_ptr<Scratch> make_scratch() const override { return std::make_unique<Buffers>(); }

  void hide(const HideInput& input, Scratch& scratch, FragmentList& out,
            HideCounters& counters) const override {
    auto& buffers = static_cast<Buffers&>(scratch);
    const PixelRect& rect = input.samples->rect;
    const PixelRect everywhere{0, 0, rect.width(), rect.height()};
    buffers.fragments.begin(input);
    buffers.depth.begin(rect, input.samples->samples_per_pixel);
    for (size_t g = 0; g < input.grids.size(); ++g) {
      ClipGrid& clip = buffers.clip;
      clip.set(*input.grids[g].grid, input.raster_clip);
      const auto count = uint64_t(clip.grid().micropolygon_count());
      counters.micropolygons += count;
      counters.nonfinite_dropped += clip.dropped_count();
      const float size = std::max(std::abs(clip.z_min()), std::abs(clip.z_max()));
      uint64_t tested = 0;
      if (clip.z_min() - depth_margin * size <= buffers.depth.farthest(everywhere)) {
        for (const ClipSegment& segment : clip.segments())
          tested += hide_segment(input, g, segment, buffers, counters);
        if (input.grids[g].opaque) buffers.depth.update(everywhere, buffers.fragments);
      }
      counters.micropolygons_culled += count - std::min(tested, count);
    }
    buffers.fragments.resolve(input, out);
    counters.samples += input.samples->size();
    counters.fragments += out.size();
  }

 private:
  uint64_t hide_segment(const HideInput& input, size_t g, const ClipSegment& segment,
                        Buffers& buffers, HideCounters& counters) const {
    DualGridJob job;
    job.test =
        pixel_test_job(input, buffers.clip, segment, input.grids[g].opaque, buffers.fragments);
    job.clip = &buffers.clip;
    job.segment = &segment;
    job.rect = input.samples->rect;
    job.tile_size = job.test.motion || job.test.lens ? tile_size_ : 1;
    // A profile may round a little past its extent.
    job.lens = job.test.lens ? input.lens_extent * (1 + 0x1p-18f) : 0.0f;
    job.id0 = buffers.fragments.ids().id(g, 0);
    job.tests_per_pixel = input.tests_per_pixel;
    job.scratch = &buffers.dual;
    job.counters = &counters;
    return hide_dual_grid(job);
  }

  int tile_size_;
};

std::unique_ptr<Hider> make_dual(std::string_view arguments) {
  int tile = 1;
  if (!arguments.empty()) {
    const char* end = arguments.data() + arguments.size();
    const auto [stop, error] = std::from_chars(arguments.data(), end, tile);
    if (error != std::errc() || stop != end || tile < 1 || tile > 64)
      throw Error(fmt::format("hider dual: found \"{}\"; expected a tile size of 1 to 64 pixels",
                              arguments));
  }
  return std::make_unique<DualHider>(tile);
}

}  // namespace

HiderDefinition hider_dual() {
  return {"dual",
          "intervals of lens and time for each tile and micropolygon, after Laine et al. 2011; "
          "dual:N sets tiles of N pixels (1)",
          make_dual};
}

}  // namespace tessera
