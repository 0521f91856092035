#include "engine/time_planner.h"

#include <algorithm>

namespace tessera {
namespace {

/// Share of the time left that a pass takes which is to tell what passes cost, and the least that
/// tells it. Samples are cheaper where there are many: vectors of them are filled.
constexpr double pilot_share = 0.06, telling_share = 0.03;
constexpr int telling_samples = 16;

/// It has at least `pilot_growth` times the samples of the one before, for fewer tell nothing new,
/// if they take no more than a share of the time left. The second pass may take more, as its
/// samples are far cheaper than the first lets one expect.
constexpr double most_pilot_share = 0.15, most_second_share = 0.5;
constexpr int pilot_growth = 4;

/// Cost is fitted to two passes of which one has at least this many times the samples of the other.
constexpr double fitted_growth = 2;

/// Share of a short pass that counts when a longer one is compared with it: it may have shaded what
/// the other found ready, and short passes are measured badly. Samples then come out dearer rather
/// than cheaper.
constexpr double short_pass_share = 0.8;

/// Of what a sample costs if nothing but the filter and dicing are fixed: the least that it is
/// taken for, by a pass of few samples and of `telling_samples`, and the least that one can be sure
/// of. What looks fixed from few samples is mostly vectors that they do not fill. After
/// `sure_passes` nothing further is tried.
constexpr double least_sample_share = 0.5, least_telling_share = 0.9, sure_sample_share = 0.8;
constexpr size_t sure_passes = 4;

/// Share of its seconds that a pass has the cores for when the machine has nothing else to do. The
/// last buckets are rendered while some threads have none.
constexpr double quiet_cores = 0.75;

/// Shares of the time left that a large pass takes: where nothing else runs, and where something
/// does and there is time to make up for it.
constexpr double quiet_share = 0.95, busy_share = 0.75;

/// Share of the whole time below which a pass takes all that is left though the machine is busy.
constexpr double last_of_time = 0.35;

/// Share of the time asked for, and of the samples that there are, below which another pass is not
/// worth it.
constexpr double time_left_over = 0.05, samples_left_over = 1.0 / 16;

/// See replaces_what_was_before(). A filtered image of 8 samples harms one of 56; one of 16 does
/// not harm one of 48.
constexpr int replacing_growth = 6, filtered_replacing_growth = 3;

double core_s(const TimedPass& pass) {
  const double known_s = pass.core_s > 0 ? std::min(pass.core_s, pass.seconds) : pass.seconds;
  return std::max(known_s, 1e-9);
}

/// Core seconds that `part_s` of its seconds took.
double part_core_s(const TimedPass& pass, double part_s) {
  return std::clamp(part_s / std::max(pass.seconds, 1e-9), 0.0, 0.999) * core_s(pass);
}

}  // namespace

bool replaces_what_was_before(int samples, int before, bool filtered) {
  return samples > (filtered ? filtered_replacing_growth : replacing_growth) * before;
}

TimePlanner::Cost TimePlanner::cost() const {
  const auto warm = passes_.begin() + (passes_.size() > 2);
  const auto by_samples = [](const TimedPass& a, const TimedPass& b) {
    return a.samples < b.samples;
  };
  // The pass before may have been of few samples to fill the time: what many cost is known better.
  const TimedPass& few = *std::min_element(warm, passes_.end(), by_samples);
  const TimedPass& many = *std::max_element(warm, passes_.end(), by_samples);
  const double known_s = part_core_s(many, many.filter_s + many.dice_s);
  const double most_sample_s = (core_s(many) - known_s) / many.samples;
  // What is diced again is so for lack of memory, unless it is the first pass.
  const double fixed_s = passes_.size() > 1 ? known_s : part_core_s(many, many.filter_s);
  if (many.samples < fitted_growth * few.samples) return {fixed_s, most_sample_s, false};
  const double few_s = core_s(few) - part_core_s(few, few.filter_s + few.dice_s);
  const double slope_s =
      (core_s(many) - known_s - short_pass_share * few_s) / double(many.samples - few.samples);
  const double least = many.samples >= telling_samples ? least_telling_share : least_sample_share;
  const double sample_s = std::clamp(slope_s, least * most_sample_s, most_sample_s);
  const bool sure = sample_s >= sure_sample_share * most_sample_s || passes_.size() >= sure_passes;
  // The first pass may have shaded more than its share: it says too little of one that follows.
  if (!sure && passes_.size() == 2) return {fixed_s, most_sample_s, false};
  return {core_s(many) - sample_s * many.samples, sample_s, sure};
}

/// Of the last two passes, without the first where there are others.
double TimePlanner::cores_had() const {
  double seconds = 0, cores_s = 0;
  for (size_t i = passes_.size() - std::min<size_t>(2, std::max<size_t>(passes_.size() - 1, 1));
       i < passes_.size(); ++i)
    seconds += passes_[i].seconds, cores_s += core_s(passes_[i]);
  return std::clamp(cores_s / std::max(seconds, 1e-9), 1e-6, 1.0);
}

double TimePlanner::affordable(double seconds, const Cost& cost) const {
  return (seconds * cores_had() - cost.fixed_s) / cost.sample_s;
}

double TimePlanner::wanted_samples(double left_s, const Cost& cost) const {
  const TimedPass& last = passes_.back();
  const bool telling = passes_.size() >= sure_passes ||
                       (last.samples >= telling_samples && last.seconds >= telling_share * left_s);
  if (!cost.sure || !telling) {
    const double samples = pilot_growth * double(last.samples);
    const double share = passes_.size() == 1 ? most_second_share : most_pilot_share;
    if (samples <= affordable(share * left_s, cost))
      return std::max(samples, affordable(pilot_share * left_s, cost));
    if (passes_.size() == 1) return unit_;
  }
  const bool quiet = cores_had() >= quiet_cores || left_s < last_of_time * time_s_;
  return affordable((quiet ? quiet_share : busy_share) * left_s, cost);
}

std::optional<int> TimePlanner::next(const TimedPass& last) {
  passes_.push_back(last), samples_ += last.samples;
  const double left_s = time_s_ - reserve_s_ - last.elapsed_s;
  if (left_s <= time_left_over * time_s_) return std::nullopt;
  const Cost costs = cost();
  const double fits = affordable(quiet_share * left_s, costs);
  if (fits < unit_ || fits < samples_left_over * samples_) return std::nullopt;
  const double wanted = std::max(wanted_samples(left_s, costs), double(unit_));
  const int left = (most_ - samples_) / unit_ * unit_;
  samples_spent_ = left <= 0;
  if (samples_spent_) return std::nullopt;
  return int(std::min(wanted, double(left))) / unit_ * unit_;
}

}  // namespace tessera
