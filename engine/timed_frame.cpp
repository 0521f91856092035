#include "engine/timed_frame.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "base/hash.h"
#include "engine/accuracy_target.h"
#include "engine/image_mean.h"
#include "engine/time_planner.h"
#include "images/compare.h"

namespace tessera {
namespace {

/// Keeps the passes of a frame apart from each other, and from a frame of one pass.
constexpr uint32_t pass_seed = 0x71e3dfu;

Image colours_of(const Image& image) {
  Image colours(image.display_window, image.data_window);
  for (const Image::Channel& channel : image.channels)
    if (channel.name == "R" || channel.name == "G" || channel.name == "B")
      colours.channels.push_back(channel);
  return colours;
}

/// Of all threads of the program.
double core_seconds() {
  timespec time{};
  if (clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time) != 0) return 0;
  return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

/// relMSE of R, G and B; 0 where there are none.
double difference_squared(const Image& a, const Image& b) {
  const Image colours = colours_of(b);
  return colours.channels.empty() ? 0.0 : compare_images(colours_of(a), colours).rel_mse;
}

class TimedFrame {
 public:
  TimedFrame(FramePasses& passes, const Settings& settings)
      : passes_(passes),
        settings_(settings),
        target_(accuracy_target(settings)),
        planner_(target_.time_s.value_or(0), write_seconds(passes), passes.sample_unit(),
                 std::max(int(target_.max_samples), passes.sample_unit())) {}

  FrameResult render(Diagnostics& diagnostics) {
    std::optional<int> samples = first();
    while (samples && add_pass(*samples)) samples = next();
    if (complete_) warn_if_late(target_, passes_.elapsed_s(), samples_, diagnostics);
    if (complete_ && target_.time_s) warn_at_limit(diagnostics);
    return passes_.finish(std::move(frame_), statistics(), !complete_);
  }

 private:
  std::optional<int> first() const {
    return target_.passes.empty() ? planner_.first_samples() : target_.passes.front();
  }
  std::optional<int> next() {
    const size_t done = rendered_.size();
    if (target_.time_s) return planner_.next(last_pass_);
    return done < target_.passes.size() ? std::optional(target_.passes[done]) : std::nullopt;
  }

  /// False when it was cancelled: the passes before make the image, if there are any.
  bool add_pass(int samples) {
    const double start_s = passes_.elapsed_s(), start_core_s = core_seconds();
    PassResult pass = passes_.render(
        samples, hash_combine(hash_combine(settings_.seed, pass_seed), uint32_t(rendered_.size())));
    const double end_s = passes_.elapsed_s();
    last_pass_ = {samples,       end_s - start_s,
                  end_s,         (core_seconds() - start_core_s) / passes_.threads(),
                  pass.filter_s, pass.dice_s};
    complete_ = pass.complete;
    if (!complete_ && samples_ > 0) return false;
    rendered_.push_back(samples), passes_s_.push_back(last_pass_.seconds);
    merge(std::move(pass), samples);
    return complete_;
  }

  void merge(PassResult&& pass, int samples) {
    if (samples_ > 0)
      single_error_squared_ = difference_squared(frame_.image, pass.image) /
                              (1.0 / double(samples_) + 1.0 / double(samples));
    if (replaces_what_was_before(samples, samples_, passes_.plan().filters_distribution())) {
      frame_ = std::move(pass), samples_ = samples;
      return;
    }
    samples_ += samples;
    take_closest(passes_.groups(), pass.image, frame_.image);
    average(passes_.groups(), pass.image, double(samples) / double(samples_), frame_.image);
  }

  void warn_at_limit(Diagnostics& diagnostics) const {
    if (!planner_.samples_spent()) return;
    diagnostics.warn_once(
        "limit of samples",
        fmt::format("the frame came to the limit of {:.0f} samples a pixel in {:.3g} s of {:.3g} s; "
                    "--max-spp sets the limit",
                    target_.max_samples, passes_.elapsed_s(), *target_.time_s));
  }

  AccuracyStatistics statistics() const {
    AccuracyStatistics result;
    if (target_.time_s) result.numbers.emplace_back("time_target_s", *target_.time_s);
    if (rendered_.size() > 1)
      result.numbers.emplace_back("error_expected", std::sqrt(single_error_squared_ / samples_));
    result.numbers.insert(result.numbers.end(), {{"spp_mean", double(samples_)},
                                                 {"spp_limit", target_.max_samples},
                                                 {"passes", double(rendered_.size())}});
    result.words.emplace_back("passes_s", fmt::format("{:.3g}", fmt::join(passes_s_, ",")));
    result.words.emplace_back(
        "repeat", fmt::format("--seed {} --passes {}", settings_.seed, fmt::join(rendered_, ",")));
    return result;
  }

  FramePasses& passes_;
  const Settings& settings_;
  const AccuracyTarget target_;
  TimePlanner planner_;
  PassResult frame_;
  int samples_ = 0;            ///< of the passes that make the image
  std::vector<int> rendered_;  ///< samples of every pass
  std::vector<double> passes_s_;
  bool complete_ = true;
  TimedPass last_pass_;
  /// What one sample a pixel would have, if errors fell with the root of their number: images with
  /// a and b samples differ by 1 / a + 1 / b of it.
  double single_error_squared_ = 0;
};

}  // namespace

FrameResult render_within_time(FramePasses& passes, const Settings& settings,
                               Diagnostics& diagnostics) {
  return TimedFrame(passes, settings).render(diagnostics);
}

}  // namespace tessera
