#pragma once
/// A frame that is set up once and rendered in one or several passes: each pass has samples of its
/// own and gives a whole image. Grids and what was shaded on them stay for the passes that follow,
/// within Settings::memory_bytes.

#include <memory>
#include <optional>
#include <vector>

#include "engine/bucket_queue.h"
#include "engine/frame.h"
#include "engine/frame_setup.h"
#include "engine/frame_statistics.h"
#include "engine/sample_allocation.h"
#include "hide/hide.h"

namespace tessera {

/// What a pass over a frame came to.
struct PassResult {
  Image image;
  /// R, G and B by the pixel filter alone; only where a method for distribution effects made
  /// `image`.
  std::optional<Image> plain;
  bool complete = true;  ///< false after a cancellation: buckets are missing
  double filter_s = 0;   ///< seconds that a method for distribution effects took
  double dice_s = 0;     ///< seconds of a thread that dicing took, their mean
};

class FramePasses {
 public:
  /// Everything given must outlive it. `several`: there may be more than one pass. Their pixels
  /// are then linear: the exposure has its gain but not its gamma, which finish() applies.
  /// Throws Error when the settings or the scene cannot be rendered.
  FramePasses(const Scene& scene, const Settings& settings, Diagnostics& diagnostics,
              const FrameControl& control, bool several);

  const FramePlan& plan() const { return plan_; }
  /// The pixels to sample: the crop, and what reaches into it.
  const PixelRect& sampled() const { return buckets_.sampled; }
  PixelRect crop() const { return camera_.crop(); }
  const std::vector<const AovDefinition*>& groups() const { return groups_; }
  /// Whether pixels may have different numbers of samples: not where the hider prescribes them.
  bool adaptive() const;
  /// The fewest samples of a pixel, as a power of two: hiders that prescribe them want some.
  int lowest_level() const;
  /// Where all pixels have as many, their number is a multiple of this.
  int sample_unit() const { return adaptive() ? 1 : plan_.samples_per_pixel; }
  int threads() const { return threads_; }
  double elapsed_s() const { return statistics_.elapsed_s(); }

  /// One pass with the plan's own number of samples.
  PassResult render() { return render(plan_.samples_per_pixel, settings_.seed); }
  /// One pass with `samples` in each pixel, and the extra samples of the plan.
  PassResult render(int samples, uint32_t seed);
  /// One pass with the samples of `allocation`, which covers sampled(). Passes of different seeds
  /// are independent.
  PassResult render(const SampleAllocation& allocation, uint32_t seed);

  /// Once, after the last pass. `accuracy`: what is known of how near the image is. `cancelled`:
  /// there would have been more passes.
  FrameResult finish(PassResult&& pass, AccuracyStatistics&& accuracy = {}, bool cancelled = false);

 private:
  struct Samples {
    const SamplePattern* pattern = nullptr;
    const ExtraPatterns* extra = nullptr;
    const SampleAllocation* allocation = nullptr;
    const LevelPatterns* levels = nullptr;
  };
  void set_up_surfaces();
  PassResult render(const Samples& samples);
  void render_strip(const Samples& samples, const Strip& strip, std::optional<BucketQueue>& queue,
                    PassResult& result);
  ReconstructionSettings strip_settings(const Strip& strip) const;
  std::vector<Strip> strips_that_fit() const;
  const ShutterProfile* shutter() const;
  const LensProfile* lens() const;
  int known_passes() const;  // 0: how many there will be is not known
  SampleExtras extras() const { return {plan_.area_lights, plan_.bounce}; }

  FrameStatistics statistics_;  // starts the frame's clock
  const Settings& settings_;
  Diagnostics& diagnostics_;
  const FrameControl& control_;
  const bool several_;
  const Scene scene_;
  const Camera camera_;
  std::shared_ptr<ShaderBindings> bindings_;
  const FramePlan plan_;
  const BucketLayout buckets_;
  const int threads_;
  std::vector<const AovDefinition*> groups_;
  std::unique_ptr<Hider> hider_;
  std::shared_ptr<const ReconstructionMethod> reconstruction_method_;
  const std::vector<Strip> strips_;
  std::unique_ptr<Shading> shading_;
  std::unique_ptr<Displacer> displacer_;
  std::unique_ptr<GridSource> grids_;  // null: nothing to see
  std::optional<Heatmap> heatmap_;
  int pass_count_ = 0;  // begun
};

/// Seconds that writing the frame may take, at the most that is to be expected.
double write_seconds(const FramePasses& passes);

}  // namespace tessera
