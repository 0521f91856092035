#include "hide/tuple_hider.h"

#include <algorithm>
#include <charconv>
#include <limits>

#include "base/error.h"
#include "hide/depth_margin.h"
#include "hide/tuple_grid.h"
#include "hide/tuple_table.h"

namespace tessera {
namespace {

class TupleHider final : public Hider {
 public:
  /// A `count` of 0 means as many tuples as there can be.
  TupleHider(SampleTuples::Kind kind, int count) : kind_(kind), count_(count) {}

  class Buffers final : public Scratch {
   public:
    ClipGrid clip;
    TupleSamples samples;
    TupleGridScratch grid;
    FragmentBuffer opaque_hits;  // in the order of `samples`
    FragmentBuffer fragments;    // in the order of the bucket
    std::vector<float> farthest;
    std::vector<uint8_t> met;
  };

  std::unique_ptr<Scratch> make_scratch() const override { return std::make_unique<Buffers>(); }

  SampleTuples sample_tuples(int samples_per_pixel) const override {
    SampleTuples tuples{kind_, count_};
    if (count_ == 0) {
      const int total = tiled() ? 4 * samples_per_pixel : samples_per_pixel;
      tuples.count = std::min(total, max_tuples);
      while (total % tuples.count != 0) --tuples.count;
    }
    check_tuples(tuples, samples_per_pixel);
    return tuples;
  }

  void hide(const HideInput& input, Scratch& scratch, FragmentList& out,
            HideCounters& counters) const override {
    auto& buffers = static_cast<Buffers&>(scratch);
    begin(input, buffers);
    for (size_t g = 0; g < input.grids.size(); ++g) hide_grid(input, g, buffers, counters);
    return_to_bucket_order(buffers);
    buffers.fragments.resolve(input, out);
    counters.samples += input.samples->size();
    counters.fragments += out.size();
  }

 private:
  /// Boxes are snapped to the tiles over which tuples are permuted.
  bool tiled() const { return kind_ == SampleTuples::Kind::interleaved; }

  void begin(const HideInput& input, Buffers& buffers) const {
    const SampleTuples tuples = sample_tuples(input.samples->samples_per_pixel);
    buffers.samples.arrange(*input.samples, size_t(tuples.count), tiled() ? 1 : 0);
    buffers.farthest.assign(size_t(tuples.count), std::numeric_limits<float>::infinity());
    for (size_t n = 0; n < buffers.farthest.size(); ++n)  // in a small bucket some have no samples
      if (buffers.samples.tuple_begin(n) == buffers.samples.tuple_begin(n + 1))
        buffers.farthest[n] = std::numeric_limits<float>::lowest();
    buffers.fragments.begin(input);
    HideInput opaque = input;
    opaque.features.transparency = false;  // no lists there
    buffers.opaque_hits.begin(opaque);
  }

  static void hide_grid(const HideInput& input, size_t g, Buffers& buffers,
                        HideCounters& counters) {
    ClipGrid& clip = buffers.clip;
    clip.set(*input.grids[g].grid, input.raster_clip);
    const auto count = size_t(clip.grid().micropolygon_count());
    counters.micropolygons += count;
    counters.nonfinite_dropped += clip.dropped_count();
    const float size = std::max(std::abs(clip.z_min()), std::abs(clip.z_max()));
    const float nearest = clip.z_min() - depth_margin * size;
    if (nearest > *std::max_element(buffers.farthest.begin(), buffers.farthest.end())) {
      counters.micropolygons_culled += count;
      return;
    }
    buffers.met.assign(count, 0);
    for (const ClipSegment& segment : clip.segments())
      hide_tuple_grid(grid_job(input, g, segment, buffers, counters));
    counters.micropolygons_culled +=
        uint64_t(std::count(buffers.met.begin(), buffers.met.end(), uint8_t(0)));
  }

  static TupleGridJob grid_job(const HideInput& input, size_t g, const ClipSegment& segment,
                               Buffers& buffers, HideCounters& counters) {
    TupleGridJob job;
    job.frame = coverage_frame(input, buffers.clip.grid(), segment);
    job.clip = &buffers.clip, job.segment = &segment;
    job.samples = &buffers.samples;
    job.motion = buffers.clip.moves(), job.lens = input.features.lens;
    job.opaque = input.grids[g].opaque;
    job.id0 = buffers.fragments.ids().id(g, 0);
    job.opaque_hits = &buffers.opaque_hits, job.fragments = &buffers.fragments;
    job.farthest = buffers.farthest, job.met = buffers.met;
    job.pixel_tests = input.tests_per_pixel;
    job.samples_per_pixel = uint32_t(input.samples->samples_per_pixel);
    job.scratch = &buffers.grid;
    job.counters = &counters;
    return job;
  }

  static void return_to_bucket_order(Buffers& buffers) {
    FragmentBuffer &from = buffers.opaque_hits, &to = buffers.fragments;
    const std::span<const uint32_t> source = buffers.samples.source();
    for (size_t place = 0; place < source.size(); ++place) {
      const size_t i = source[place];
      to.z()[i] = from.z()[place], to.id()[i] = from.id()[place];
      to.b1()[i] = from.b1()[place], to.b2()[i] = from.b2()[place];
    }
  }

  SampleTuples::Kind kind_;
  int count_;
};

}  // namespace

std::unique_ptr<Hider> make_tuple_hider(std::string_view name, SampleTuples::Kind kind,
                                        std::string_view arguments) {
  int count = 0;
  if (!arguments.empty()) {
    const char* end = arguments.data() + arguments.size();
    const auto [stop, error] = std::from_chars(arguments.data(), end, count);
    if (error != std::errc() || stop != end || count < 1 || count > max_tuples)
      throw Error(fmt::format("hider {}: found \"{}\"; expected a number of tuples of 1 to {}",
                              name, arguments, max_tuples));
  }
  return std::make_unique<TupleHider>(kind, count);
}

}  // namespace tessera
