#pragma once
/// Frames of one scene by several methods of reconstruction, each rendered when first asked for,
/// and their distance from a converged frame.

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/harness/benchmark.h"
#include "bench/maaf_protocol.h"
#include "engine/frame.h"
#include "engine/outputs.h"
#include "images/compare.h"

namespace tessera {

/// The value called `name` in a section of Statistics, 0 where there is none.
template <class Value>
double statistic(const std::vector<std::pair<std::string, Value>>& section, std::string_view name) {
  for (const auto& [key, value] : section)
    if (key == name) return double(value);
  return 0;
}

/// One method at one sample count.
struct MaafRun {
  FrameResult frame;  ///< of the first time; R, G and B only
  double rel_mse = 0;
  std::vector<double> seconds;  ///< of a frame, every time it was rendered

  double frame_s() const { return median(seconds); }
  double filter_s() const { return statistic(frame.statistics.times_s, "filter_s"); }
  /// Of the frame's time: composited samples to pixels, whose seconds are summed over threads, and
  /// what is filtered after the last bucket.
  double overhead_share() const {
    double threads = 1;
    for (const auto& [name, value] : frame.statistics.options)
      if (name == "threads") threads = std::max(1, std::atoi(value.c_str()));
    const double reconstruct_s = statistic(frame.statistics.times_s, "reconstruct_s") / threads;
    const double frame_s = statistic(frame.statistics.times_s, "frame_s");
    return frame_s > 0 ? (reconstruct_s + filter_s()) / frame_s : 0;
  }
};

class MaafRuns {
 public:
  /// Methods are those of Settings::reconstruct; "": what the renderer does by default.
  static constexpr const char *unfiltered = "filter", *aaf = "aaf";

  /// The converged frame has `reference_spp` samples of its own.
  MaafRuns(const Scene& scene, int reference_spp) : scene_(scene) {
    // Of two halves, so that they tell how noisy their mean is.
    const FrameResult a = render(unfiltered, reference_spp / 2, 1);
    reference_ = render(unfiltered, reference_spp / 2, 2);
    for (size_t c = 0; c < reference_.image.channels.size(); ++c)
      for (size_t k = 0; k < reference_.image.channels[c].values.size(); ++k) {
        float& value = reference_.image.channels[c].values[k];
        value = 0.5f * (value + a.image.channels[c].values[k]);
      }
    reference_rel_mse_ = compare_images(a.image, reference_.image).rel_mse;
  }

  const FrameResult& reference() const { return reference_; }
  /// Expected relMSE of the reference itself.
  double reference_rel_mse() const { return reference_rel_mse_; }

  const MaafRun& run(const std::string& method, int spp) {
    const auto [entry, is_new] = runs_.try_emplace({method, spp});
    if (is_new) {
      MaafRun& run = entry->second;
      run.frame = render(method, spp, 0);
      run.seconds = {statistic(run.frame.statistics.times_s, "frame_s")};
      run.rel_mse = error(run.frame.image);
    }
    return entry->second;
  }

  /// Renders again, in turn, all that has been rendered with at most `most_spp`.
  void repeat(int times, int most_spp) {
    for (int round = 0; round < times; ++round)
      for (auto& [key, run] : runs_)
        if (key.second <= most_spp)
          run.seconds.push_back(
              statistic(render(key.first, key.second, 0).statistics.times_s, "frame_s"));
  }

  /// The steps of a method that have been rendered.
  std::vector<LadderStep> ladder(const std::string& method) const {
    std::vector<LadderStep> steps;
    for (const auto& [key, run] : runs_)
      if (key.first == method) steps.push_back({double(key.second), run.rel_mse, run.frame_s()});
    return steps;
  }

  /// Sum of all values over that of the reference.
  double energy_ratio(const MaafRun& run) const {
    const double whole = energy(reference_.image);
    return whole > 0 ? energy(run.frame.image) / whole : 0;
  }

  /// FOLDER/NAME.exr and .png.
  static void write(const FrameResult& frame, const std::string& folder, const std::string& name) {
    write_frame(frame, fmt::format("{}/{}.exr", folder, name));
    write_preview(frame, fmt::format("{}/{}.png", folder, name));
  }

 private:
  FrameResult render(const std::string& method, int spp, uint32_t seed) const {
    Settings settings;
    if (!method.empty()) settings.reconstruct = method;
    settings.samples_per_pixel = spp;
    settings.seed = seed;
    Diagnostics diagnostics;
    FrameResult frame = render_frame(scene_, settings, diagnostics);
    std::erase_if(frame.image.channels, [](const Image::Channel& c) {
      return c.name != "R" && c.name != "G" && c.name != "B";
    });
    return frame;
  }

  /// The reference is independent of the image, so its own error adds to the distance, and is taken
  /// off it. Never below a tenth of the reference's own: less cannot be told.
  double error(const Image& image) const {
    const double distance = compare_images(image, reference_.image).rel_mse;
    return std::max(distance - reference_rel_mse_, 0.1 * reference_rel_mse_);
  }

  static double energy(const Image& image) {
    double sum = 0;
    for (const Image::Channel& channel : image.channels)
      for (const float value : channel.values) sum += double(value);
    return sum;
  }

  const Scene& scene_;
  FrameResult reference_;
  double reference_rel_mse_ = 0;
  std::map<std::pair<std::string, int>, MaafRun> runs_;
};

}  // namespace tessera
