#include "engine/accurate_frame.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "base/hash.h"
#include "engine/round_mean.h"
#include "engine/round_planner.h"

namespace tessera {
namespace {

/// Keeps the passes of a frame apart from each other, and from a frame of one pass.
constexpr uint32_t pass_seed = 0x5eedacc1u;

class Rounds {
 public:
  Rounds(FramePasses& passes, const Settings& settings, Diagnostics& diagnostics)
      : passes_(passes),
        settings_(settings),
        diagnostics_(diagnostics),
        target_(accuracy_target(settings)),
        mean_(passes.groups()),
        planner_(target_, double(1 << lowest_level()), write_seconds(passes),
                 passes.plan().filters_distribution()) {}

  FrameResult render() {
    SampleAllocation allocation = even_allocation(
        passes_.sampled(), int(std::lround(std::log2(planner_.first_pass_samples()))));
    while (add_round(allocation)) {
      const auto request = planner_.next(so_far());
      if (!request) break;
      allocation = allocate(smoothed(mean_.noise()), passes_.sampled(), request->error_squared,
                            {lowest_level(), request->least_pass_samples,
                             request->most_pass_samples, passes_.adaptive()});
    }
    if (mean_.empty()) return passes_.finish(std::move(interrupted_), {}, true);
    warn();
    return passes_.finish({mean_.take_image(), {}, true}, statistics(), !complete_);
  }

 private:
  /// A filter that tells noise from two halves of a pixel's samples needs two of them.
  int lowest_level() const {
    return std::max(passes_.plan().filters_distribution() ? 1 : 0, passes_.lowest_level());
  }

  PassResult pass(const SampleAllocation& allocation) {
    const double start_s = passes_.elapsed_s();
    PassResult result = passes_.render(
        allocation, hash_combine(hash_combine(settings_.seed, pass_seed), pass_count_++));
    last_pass_s_ = passes_.elapsed_s() - start_s;
    last_pass_samples_ = allocation.mean_samples();
    last_pass_even_ = allocation.least_samples() == allocation.most_samples() && passes_.adaptive();
    return result;
  }

  /// False when it was cancelled: the rounds before make the image, if there are any.
  bool add_round(const SampleAllocation& allocation) {
    PassResult a = pass(allocation);
    PassResult b = a.complete ? pass(allocation) : PassResult{{}, {}, false};
    complete_ = a.complete && b.complete;
    if (complete_) rounds_.push_back(allocation.mean_samples());
    if (complete_)
      mean_.add({std::move(a.image), std::move(b.image), std::move(a.plain), std::move(b.plain)},
                allocation);
    else
      interrupted_ = std::move(a);
    return complete_;
  }

  RoundsSoFar so_far() const {
    return {mean_.mean_samples(), mean_.error_squared(), passes_.elapsed_s(),
            last_pass_s_,         last_pass_samples_,    last_pass_even_};
  }

  double error() const { return std::sqrt(mean_.error_squared()); }
  bool error_reached() const { return planner_.end() == RoundsEnd::error_reached; }

  void warn() {
    if (target_.error && complete_ && !error_reached())
      diagnostics_.warn_once(
          "error target",
          fmt::format("an error of {} is not reached with {:.4g} samples a pixel{}: it is "
                      "estimated to be {:.4g}",
                      *target_.error, mean_.mean_samples(),
                      planner_.end() == RoundsEnd::time_spent ? " in the time given" : "",
                      error()));
    if (complete_) warn_if_late(target_, passes_.elapsed_s(), mean_.mean_samples(), diagnostics_);
  }

  AccuracyStatistics statistics() const {
    AccuracyStatistics result;
    if (target_.error) result.numbers.emplace_back("error_target", *target_.error);
    if (target_.time_s) result.numbers.emplace_back("time_target_s", *target_.time_s);
    const auto [least, most] = std::ranges::minmax(mean_.samples());
    result.numbers.insert(result.numbers.end(), {{"error_estimated", error()},
                                                 {"spp_mean", mean_.mean_samples()},
                                                 {"spp_min", double(least)},
                                                 {"spp_max", double(most)},
                                                 {"spp_limit", target_.max_samples},
                                                 {"passes", double(2 * mean_.rounds())}});
    result.words.emplace_back(
        "repeat", fmt::format("--seed {} --rounds {}", settings_.seed, fmt::join(rounds_, ",")));
    if (target_.error)
      result.words.emplace_back("error_target_reached", error_reached() ? "yes" : "no");
    return result;
  }

  FramePasses& passes_;
  const Settings& settings_;
  Diagnostics& diagnostics_;
  const AccuracyTarget target_;
  RoundMean mean_;
  RoundPlanner planner_;
  PassResult interrupted_;
  bool complete_ = true;
  uint32_t pass_count_ = 0;
  std::vector<double> rounds_;  // mean samples of each of its passes
  double last_pass_s_ = 0, last_pass_samples_ = 0;
  bool last_pass_even_ = true;
};

}  // namespace

FrameResult render_accurate(FramePasses& passes, const Settings& settings,
                            Diagnostics& diagnostics) {
  return Rounds(passes, settings, diagnostics).render();
}

}  // namespace tessera
