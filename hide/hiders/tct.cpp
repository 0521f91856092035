/// Time-continuous triangles, a baseline (Akenine-Moller, Munkberg and Hasselgren, 2007): all
/// samples in an oriented box around a moving micropolygon are tested with edge functions whose
/// coefficients are quadratic in time.
///
/// `tct:N` is its depth of field: samples lie on N lines across the lens, and each line has a pass
/// of its own, with a box around what the micropolygon sweeps along that line, long and thin. The
/// passes are the inner loop, so that edge functions are set up once for all of them.

#include <algorithm>
#include <charconv>

#include "base/error.h"
#include "hide/grid_loop.h"
#include "hide/hide.h"
#include "hide/lens_lines.h"
#include "hide/tct_test.h"

namespace tessera {
namespace {

class TctHider final : public Hider {
 public:
  /// 0 lines: samples anywhere on the lens.
  explicit TctHider(int line_count) : line_count_(line_count) {}

  class Buffers final : public Scratch, public GridLoop {
   public:
    LensLines lines;
    bool by_line = false;
    std::vector<PixelSpan> spans;
    std::vector<SampleRun> runs;
  };

  std::unique_ptr<Scratch> make_scratch() const override { return std::make_unique<Buffers>(); }

  SampleTuples sample_tuples(int) const override {
    if (line_count_ == 0) return {};
    return {SampleTuples::Kind::lens_lines, line_count_};
  }

  /// Takes samples that are not on lines too, and tests them as plain `tct` does.
  void hide(const HideInput& input, Scratch& scratch, FragmentList& out,
            HideCounters& counters) const override {
    auto& buffers = static_cast<Buffers&>(scratch);
    const SampleBlock& samples = *input.samples;
    buffers.by_line = line_count_ > 0 && input.features.lens && !samples.tuple.empty();
    if (buffers.by_line) buffers.lines.arrange(samples, line_count_);
    hide_grids(input, buffers, out, counters, [&](size_t g, const ClipSegment& segment, float) {
      return hide_segment(input, g, segment, buffers, counters);
    });
  }

 private:
  static TctJob make_job(const HideInput& input, size_t g, const ClipSegment& segment,
                         Buffers& buffers) {
    TctJob job;
    job.frame = coverage_frame(input, buffers.clip.grid(), segment);
    job.samples = buffers.by_line ? buffers.lines.samples() : sample_arrays(*input.samples);
    job.index = buffers.by_line ? buffers.lines.index() : nullptr;
    job.buffer = &buffers.fragments;
    job.motion = buffers.clip.moves(), job.lens = input.features.lens;
    job.opaque = input.grids[g].opaque;
    return job;
  }

  /// Returns the number of micropolygons that were tested.
  static uint64_t hide_segment(const HideInput& input, size_t g, const ClipSegment& segment,
                               Buffers& buffers, HideCounters& counters) {
    const ClipGrid& clip = buffers.clip;
    const TctJob job = make_job(input, g, segment, buffers);
    CoverageCounts counts;
    uint64_t micropolygons = 0;
    for (int j = 0; j < clip.v_count(); ++j)
      for (int i = 0; i < clip.u_count(); ++i) {
        const int m = j * clip.u_count() + i;
        if (clip.dropped(m)) continue;
        const Quad quad = load_quad(segment, clip.u_count(), i, j);
        const uint64_t tested = find_runs(input, job, quad, buffers);
        if (tested == 0) continue;
        ++micropolygons;
        counters.samples_tested += tested;
        const TimeEdges edges =
            set_up_time_edges(quad, job.frame, job.motion, job.lens, input.samples->rect);
        test_time_edges(job, edges, buffers.fragments.ids().id(g, 2 * uint32_t(m)), buffers.runs,
                        counts);
      }
    counters.samples_covered += counts.covered;
    counters.nonfinite_dropped += counts.nonfinite;
    return micropolygons;
  }

  /// Leaves the samples to test in buffers.runs, and returns their number.
  static uint64_t find_runs(const HideInput& input, const TctJob& job, const Quad& quad,
                            Buffers& buffers) {
    buffers.runs.clear();
    const SweptQuad swept(quad, job.frame, job.motion, input.samples->rect);
    if (swept.is_clipped(job.frame)) return 0;
    const auto per_pixel = size_t(input.samples->samples_per_pixel);
    if (!buffers.by_line) {
      const LensRegion whole{0, 0, input.features.lens ? double(input.lens_extent) : 0.0};
      swept.find_spans(whole, buffers.spans);
      return add_runs(input, buffers, [&](size_t pixel) { return pixel * per_pixel; });
    }
    uint64_t tested = 0;
    for (int line = 0; line < buffers.lines.line_count(); ++line) {
      swept.find_spans(buffers.lines.region(line), buffers.spans);
      tested +=
          add_runs(input, buffers, [&](size_t pixel) { return buffers.lines.first(line, pixel); });
    }
    return tested;
  }

  /// The samples of buffers.spans, where first(pixel) is the first of a pixel.
  template <class First>
  static uint64_t add_runs(const HideInput& input, Buffers& buffers, const First& first) {
    const auto width = size_t(input.samples->rect.width());
    uint64_t tested = 0;
    for (const PixelSpan& span : buffers.spans) {
      const size_t row = size_t(span.y) * width;
      const SampleRun run{first(row + size_t(span.x0)), first(row + size_t(span.x1))};
      if (run.begin == run.end) continue;
      buffers.runs.push_back(run);
      tested += run.end - run.begin;
    }
    if (!input.tests_per_pixel.empty())
      for (const PixelSpan& span : buffers.spans)
        for (size_t p = size_t(span.y) * width + size_t(span.x0),
                    end = p + size_t(span.x1 - span.x0);
             p < end; ++p)
          input.tests_per_pixel[p] += uint32_t(first(p + 1) - first(p));
    return tested;
  }

  int line_count_;
};

std::unique_ptr<Hider> make_tct(std::string_view arguments) {
  int lines = 0;
  if (!arguments.empty()) {
    const char* end = arguments.data() + arguments.size();
    const auto [stop, error] = std::from_chars(arguments.data(), end, lines);
    if (error != std::errc() || stop != end || lines < 1 || lines > 64)
      throw Error(fmt::format("hider tct: found \"{}\"; expected 1 to 64 lens lines", arguments));
  }
  return std::make_unique<TctHider>(lines);
}

}  // namespace

HiderDefinition hider_tct() {
  return {"tct",
          "time-continuous triangles: oriented boxes, edge functions of time; tct:N samples N "
          "lines across the lens",
          make_tct};
}

}  // namespace tessera
