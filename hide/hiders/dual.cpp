/// The method of Laine et al. 2011 as published, one micropolygon at a time: the baseline that the
/// sheared bounds are compared with. Grids behind what is known to be opaque are skipped whole;
/// nothing else is culled by depth, so that its counts compare with those of bbox and pixar.

#include <algorithm>
#include <charconv>

#include "base/error.h"
#include "hide/dual_grid.h"
#include "hide/grid_loop.h"
#include "hide/hide.h"

namespace tessera {
namespace {

class DualHider final : public Hider {
 public:
  explicit DualHider(int tile_size) : tile_size_(tile_size) {}

  class Buffers final : public Scratch, public GridLoop {
   public:
    DualScratch dual;
  };

  std::unique_ptr<Scratch> make_scratch() const override { return std::make_unique<Buffers>(); }

  void hide(const HideInput& input, Scratch& scratch, FragmentList& out,
            HideCounters& counters) const override {
    auto& buffers = static_cast<Buffers&>(scratch);
    hide_grids(input, buffers, out, counters, [&](size_t g, const ClipSegment& segment, float) {
      return hide_segment(input, g, segment, buffers, counters);
    });
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
