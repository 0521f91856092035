#pragma once
/// One bucket from samples to shaded sample values. Everything here is what a worker thread does
/// between taking a bucket and handing its samples to the film.

#include <array>
#include <chrono>
#include <memory>
#include <vector>

#include "dice/dice.h"
#include "engine/buckets.h"
#include "engine/extra_samples.h"
#include "engine/heatmap.h"
#include "engine/sample_allocation.h"
#include "engine/strips.h"
#include "hide/hide.h"
#include "reconstruct/reconstruct.h"
#include "shade/shade.h"

namespace tessera {

/// The parts of a frame that every worker shares. All outlive the workers.
struct FrameParts {
  const Camera& camera;
  const BucketLayout& buckets;
  const Strip& strip;            ///< whose rows are rendered; the film has their buckets
  const SamplePattern* pattern;  ///< null where there is an allocation
  const Hider& hider;
  HideFeatures features;
  const ShaderBindings& bindings;
  const std::vector<const AovDefinition*>& channel_groups;
  GridSource& grids;
  Shading& shading;
  Reconstruction& film;
  bool describe_samples;               ///< the film wants SampleValues::distribution
  const ExtraPatterns* extra;          ///< null: nobody gets more than `pattern` has
  const SampleAllocation* allocation;  ///< null: the samples of `pattern`, and extra ones
  const LevelPatterns* levels;         ///< of `allocation`
  bool keep_grids;                     ///< a further pass may want them
  Heatmap* heatmap;                    ///< null: nobody asks what pixels cost
};

/// Seconds a worker spent in each stage.
struct StageTimes {
  double dice_s = 0, sample_s = 0, hide_s = 0, shade_s = 0, composite_s = 0, reconstruct_s = 0;
  static constexpr auto fields() {
    return std::array{std::pair{"dice_s", &StageTimes::dice_s},
                      std::pair{"sample_s", &StageTimes::sample_s},
                      std::pair{"hide_s", &StageTimes::hide_s},
                      std::pair{"shade_s", &StageTimes::shade_s},
                      std::pair{"composite_s", &StageTimes::composite_s},
                      std::pair{"reconstruct_s", &StageTimes::reconstruct_s}};
  }
};

/// Adds the seconds since the last lap to a stage's time.
class LapTimer {
 public:
  void start() { last_ = Clock::now(); }
  void lap(double& into_s) {
    const auto now = Clock::now();
    into_s += std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_ = Clock::now();
};

/// A worker's own state: buffers that grow once and are reused, counters merged at the end.
class BucketRenderer {
 public:
  explicit BucketRenderer(const FrameParts& parts)
      : parts_(parts), scratch_(parts.hider.make_scratch()) {}

  /// Bucket (i, j) of the layout, in a row of the strip.
  void render(int i, int j);

  const HideCounters& hide_counters() const { return hide_counters_; }
  const ShadeCounters& shade_counters() const { return shade_counters_; }
  const StageTimes& times() const { return times_; }
  uint64_t extra_samples() const { return extra_samples_; }

 private:
  using Grids = std::vector<std::shared_ptr<const Grid>>;

  SampleValues even(const PixelRect& rect, const Grids& grids);
  SampleValues allocated(const PixelRect& rect, const Grids& grids);
  void visit(const SamplePattern& pattern, const PixelRect& rect, const Grids& grids);
  SampleValues shade(const Grids& grids);
  void add_extra(const std::vector<uint8_t>& chosen, const Grids& grids, SampleValues& values);
  void map_samples(const std::vector<uint8_t>& chosen, uint8_t choice, const PixelRect& rect,
                   uint32_t samples);
  void hide(const std::vector<std::shared_ptr<const Grid>>& grids);
  ShadeInput shade_input(std::span<const std::shared_ptr<const Grid>> grids);
  void add_to_heatmap();
  SampleValues composite_samples(const ShadeInput& input);

  FrameParts parts_;
  Heatmap* heatmap_ = nullptr;  // null: nobody counts this bucket
  std::unique_ptr<Hider::Scratch> scratch_;
  SampleBlock samples_;
  std::vector<HideGrid> hide_grids_;
  std::vector<uint32_t> pixel_counts_;  // for the heat map, as is
  std::vector<glm::vec2> shaded_places_;
  FragmentList fragments_;
  ShadedFragments shaded_;
  LapTimer timer_;
  HideCounters hide_counters_;
  ShadeCounters shade_counters_;
  StageTimes times_;
  uint64_t extra_samples_ = 0;
};

}  // namespace tessera
