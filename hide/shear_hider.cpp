#include "hide/shear_hider.h"

#include <algorithm>
#include <charconv>

#include "base/error.h"
#include "hide/boxed_grid.h"
#include "hide/grid_loop.h"
#include "hide/hide.h"
#include "hide/sheared_grid.h"
#include "hide/static_grid.h"

namespace tessera {
namespace {

class ShearHider final : public Hider {
 public:
  ShearHider(int tile_size, LittleBlur little_blur)
      : tile_size_(tile_size), little_blur_(little_blur) {}

  class Buffers final : public Scratch, public GridLoop {
   public:
    PixelBoxes boxes;
    BlurScratch blur;
    ShearScratch shear;
  };

  std::unique_ptr<Scratch> make_scratch() const override { return std::make_unique<Buffers>(); }

  void hide(const HideInput& input, Scratch& scratch, FragmentList& out,
            HideCounters& counters) const override {
    auto& buffers = static_cast<Buffers&>(scratch);
    hide_grids(input, buffers, out, counters,
               [&](size_t g, const ClipSegment& segment, float nearest) {
                 return hide_segment(input, g, segment, nearest, buffers, counters);
               });
  }

 private:
  uint64_t hide_segment(const HideInput& input, size_t g, const ClipSegment& segment, float nearest,
                        Buffers& buffers, HideCounters& counters) const {
    if (!buffers.clip.moves() && !input.features.lens)
      return hide_static(input, g, segment, buffers, counters);
    if (little_blur_ == LittleBlur::boxed &&
        swept_growth(input, buffers.clip, segment) < boxed_growth)
      return hide_boxed(input, g, segment, buffers, counters);
    return hide_blurred(input, g, segment, nearest, buffers, counters);
  }

  static uint64_t hide_boxed(const HideInput& input, size_t g, const ClipSegment& segment,
                             Buffers& buffers, HideCounters& counters) {
    const PixelTestJob test =
        pixel_test_job(input, buffers.clip, segment, input.grids[g].opaque, buffers.fragments);
    return hide_boxed_grid({input, buffers.clip, segment, test, buffers.fragments.ids().id(g, 0),
                            buffers.depth, counters});
  }

  static uint64_t hide_static(const HideInput& input, size_t g, const ClipSegment& segment,
                              Buffers& buffers, HideCounters& counters) {
    StaticGridJob job;
    job.test =
        pixel_test_job(input, buffers.clip, segment, input.grids[g].opaque, buffers.fragments);
    job.clip = &buffers.clip;
    job.rect = input.samples->rect;
    job.id0 = buffers.fragments.ids().id(g, 0);
    job.y_stratified = input.samples->y_stratified;
    job.depth = &buffers.depth;
    job.boxes = &buffers.boxes;
    job.counters = &counters;
    return hide_static_grid(job);
  }

  uint64_t hide_blurred(const HideInput& input, size_t g, const ClipSegment& segment, float nearest,
                        Buffers& buffers, HideCounters& counters) const {
    ShearedGridJob sheared;
    BlurredGridJob& job = sheared.blur;
    job.test =
        pixel_test_job(input, buffers.clip, segment, input.grids[g].opaque, buffers.fragments);
    job.clip = &buffers.clip;
    job.segment = &segment;
    job.rect = input.samples->rect;
    job.box = SampleBox(job.rect, input.features.lens ? input.lens_extent : 0.0f);
    job.tile_size = tile_size_;
    job.time_span = time_span(input, segment, size_t(buffers.clip.grid().vertex_count()));
    job.z_nearest = nearest;
    job.id0 = buffers.fragments.ids().id(g, 0);
    job.scratch = &buffers.blur;
    job.counters = &counters;
    job.t_first = job.test.frame.t_begin, job.t_last = job.test.frame.t_last;
    sheared.scratch = &buffers.shear;
    return job.time_span.empty() ? 0 : hide_sheared_grid(sheared);
  }

  static SampleInterval time_span(const HideInput& input, const ClipSegment& s, size_t count) {
    float z_min[2] = {s.z[0], INFINITY}, z_max[2] = {s.z[0], -INFINITY};
    for (size_t i = 0; i < count; ++i) {
      const float end = s.dz ? s.z[i] + s.dz[i] : s.z[i];
      z_min[0] = std::min(z_min[0], s.z[i]), z_max[0] = std::max(z_max[0], s.z[i]);
      z_min[1] = std::min(z_min[1], end), z_max[1] = std::max(z_max[1], end);
    }
    return depth_interval(z_min, z_max, input.near_clip, input.far_clip);
  }

  int tile_size_;
  LittleBlur little_blur_;
};

}  // namespace

std::unique_ptr<Hider> make_shear_hider(std::string_view name, std::string_view arguments,
                                        LittleBlur little_blur) {
  int tile = 4;
  if (!arguments.empty()) {
    const char* end = arguments.data() + arguments.size();
    const auto [stop, error] = std::from_chars(arguments.data(), end, tile);
    if (error != std::errc() || stop != end || tile < 1 || tile > 64)
      throw Error(fmt::format("hider {}: found \"{}\"; expected a tile size of 1 to 64 pixels",
                              name, arguments));
  }
  return std::make_unique<ShearHider>(tile, little_blur);
}

}  // namespace tessera
