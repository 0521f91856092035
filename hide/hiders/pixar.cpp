/// The modified Pixar method (Laine et al. 2011, section 2, after Cook et al. 1990): the space of
/// (u, v, t) is cut into strata, and of each stratum the samples within a screen box around the
/// micropolygon over that stratum are tested. A baseline: like bbox it culls nothing by depth.

#include <charconv>

#include "base/error.h"
#include "hide/hide.h"
#include "hide/stratum_test.h"

namespace tessera {
namespace {

constexpr int largest_axis = 64, largest_total = 4096;

class PixarHider final : public Hider {
 public:
  explicit PixarHider(const StrataCounts& strata) : strata_(strata) {}

  class Buffers final : public Scratch {
   public:
    ClipGrid clip;
    FragmentBuffer fragments;
    StratifiedSamples strata;
    std::vector<std::pair<int, SweptRange>> ranges;  ///< strata that meet the segment
    std::vector<StratumBox> boxes;
  };

  std::unique_ptr<Scratch> make_scratch() const override { return std::make_unique<Buffers>(); }

  void hide(const HideInput& input, Scratch& scratch, FragmentList& out,
            HideCounters& counters) const override {
    auto& buffers = static_cast<Buffers&>(scratch);
    buffers.fragments.begin(input);
    buffers.strata.set(*input.samples, strata_, input.lens_extent);
    for (size_t g = 0; g < input.grids.size(); ++g) {
      ClipGrid& clip = buffers.clip;
      clip.set(*input.grids[g].grid, input.raster_clip);
      counters.micropolygons += uint64_t(clip.grid().micropolygon_count());
      counters.nonfinite_dropped += clip.dropped_count();
      for (const ClipSegment& segment : clip.segments())
        hide_segment(input, segment, g, buffers, counters);
    }
    buffers.fragments.resolve(input, out);
    counters.samples += input.samples->size();
    counters.fragments += out.size();
  }

 private:
  static void hide_segment(const HideInput& input, const ClipSegment& segment, size_t g,
                           Buffers& buffers, HideCounters& counters) {
    const ClipGrid& clip = buffers.clip;
    PixelTestJob job =
        pixel_test_job(input, clip, segment, input.grids[g].opaque, buffers.fragments);
    job.samples = buffers.strata.arrays();
    find_ranges(buffers.strata, job, buffers.ranges);
    CoverageCounts counts;
    for (int j = 0; j < clip.v_count(); ++j)
      for (int i = 0; i < clip.u_count(); ++i) {
        const int m = j * clip.u_count() + i;
        if (clip.dropped(m)) continue;
        const Quad quad = load_quad(segment, clip.u_count(), i, j);
        find_boxes(input, quad, job.motion, buffers);
        counters.samples_tested +=
            test_strata(job, buffers.strata, quad, buffers.fragments.ids().id(g, 2 * uint32_t(m)),
                        buffers.boxes, counts);
        if (!input.tests_per_pixel.empty()) count_tests(buffers, input.tests_per_pixel, job);
      }
    counters.samples_covered += counts.covered;
    counters.nonfinite_dropped += counts.nonfinite;
  }

  /// A grid that stands still is seen alike in all strata of time.
  static void find_ranges(const StratifiedSamples& strata, const PixelTestJob& job,
                          std::vector<std::pair<int, SweptRange>>& ranges) {
    ranges.clear();
    SweptRange range;
    for (int s = 0; s < strata.count(); ++s)
      if (strata.range(s, job.frame, range)) ranges.emplace_back(s, range);
  }

  static void find_boxes(const HideInput& input, const Quad& quad, bool moves, Buffers& buffers) {
    const SweptBox box(input, quad, moves);
    buffers.boxes.clear();
    for (const auto& [stratum, range] : buffers.ranges) {
      const PixelRect pixels = box.pixels(range);
      if (!pixels.empty()) buffers.boxes.push_back({stratum, pixels});
    }
  }

  static void count_tests(const Buffers& buffers, std::span<uint32_t> tests,
                          const PixelTestJob& job) {
    for (const StratumBox& box : buffers.boxes)
      for (int y = box.pixels.y0; y < box.pixels.y1; ++y)
        for (int x = box.pixels.x0; x < box.pixels.x1; ++x)
          tests[size_t(y) * job.pixels_per_row + size_t(x)] +=
              uint32_t(buffers.strata.first(box.stratum, x + 1, y) -
                       buffers.strata.first(box.stratum, x, y));
  }

  StrataCounts strata_;
};

std::unique_ptr<Hider> make_pixar(std::string_view arguments) {
  StrataCounts strata{2, 2, 4};
  if (arguments.empty()) return std::make_unique<PixarHider>(strata);
  const char *at = arguments.data(), *end = at + arguments.size();
  int* const counts[3] = {&strata.u, &strata.v, &strata.t};
  bool good = true;
  for (int axis = 0; axis < 3 && good; ++axis) {
    if (axis > 0) good = at != end && *at++ == 'x';
    const auto [stop, error] = std::from_chars(at, end, *counts[axis]);
    good = good && error == std::errc() && *counts[axis] >= 1 && *counts[axis] <= largest_axis;
    at = stop;
  }
  if (!good || at != end || strata.total() > largest_total)
    throw Error(fmt::format(
        "hider pixar: found \"{}\"; expected strata in u, v and t as in \"2x2x4\", each 1 to {} "
        "and at most {} in all",
        arguments, largest_axis, largest_total));
  return std::make_unique<PixarHider>(strata);
}

}  // namespace

HiderDefinition hider_pixar() {
  return {"pixar",
          "a box for each stratum of lens and shutter; pixar:N1xN2xN3 sets the strata in u, v and "
          "t (2x2x4)",
          make_pixar};
}

}  // namespace tessera
