#include "engine/round_planner.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tessera {
namespace {

/// Samples a pixel of each of the first two passes, and as many as may well do where an error of
/// loose_error or more is asked for.
constexpr double first_samples = 4, first_loose_samples = 1;
constexpr double loose_error = 0.1;

/// A round has at most this many times the samples of all before: what they tell of the noise is
/// noise itself, and how it falls with samples is not known before it has been tried.
constexpr double most_growth = 8;

/// And at least this many times, however little is missing: few samples at a time are badly
/// stratified.
constexpr double least_growth = 0.5;

/// The same where there is bias: the next round has to do without those before.
constexpr double least_biased_growth = 1;

/// Rounds aim a little below the target, so that chance does not make them miss it every other
/// time.
constexpr double aim = 0.97;

/// Share of the remaining time that a round may take, as it is predicted: cores are shared.
constexpr double time_share = 0.92;

/// The same as long as nothing is known but what a pass with even samples takes.
constexpr double time_share_at_first = 0.4;

/// Share of the time asked for that is not worth another round.
constexpr double time_left_over = 0.04;

}  // namespace

RoundPlanner::RoundPlanner(const AccuracyTarget& target, double least_pass_samples,
                           double reserve_s, bool biased)
    : target_(target),
      least_pass_samples_(least_pass_samples),
      reserve_s_(reserve_s),
      biased_(biased) {}

double RoundPlanner::first_pass_samples() const {
  if (!target_.rounds.empty())
    return std::exp2(std::clamp(std::round(std::log2(target_.rounds.front())), 0.0, 14.0));
  // What a sample costs is not known yet.
  if (target_.time_s) return least_pass_samples_;
  double samples = target_.error >= loose_error ? first_loose_samples : first_samples;
  while (2 * samples > target_.max_samples && samples > least_pass_samples_) samples /= 2;
  return std::max(samples, least_pass_samples_);
}

std::optional<RoundRequest> RoundPlanner::next(const RoundsSoFar& so_far) {
  RoundRequest request;
  if (!target_.rounds.empty()) {
    if (rounds_begun_ < target_.rounds.size())
      return RoundRequest{0, 0, target_.rounds[rounds_begun_++]};
    end_ = RoundsEnd::repeated;
    return std::nullopt;
  }
  const double error = *target_.error;
  if (so_far.error_squared <= error * error) {
    end_ = RoundsEnd::error_reached;
    return std::nullopt;
  }
  const double wanted = aim * error * aim * error;
  // Inverses of squared errors add up, unless there is bias.
  request.error_squared = biased_ ? wanted : 1 / (1 / wanted - 1 / so_far.error_squared);
  const double left = target_.max_samples - so_far.mean_samples;
  const double affordable = affordable_samples(so_far);
  if (std::min(left, affordable) < 2 * least_pass_samples_) {
    end_ = left < affordable ? RoundsEnd::samples_spent : RoundsEnd::time_spent;
    return std::nullopt;
  }
  request.most_pass_samples =
      0.5 * std::min({left, affordable,
                      std::max(most_growth * so_far.mean_samples, 2 * least_pass_samples_)});
  request.least_pass_samples =
      std::min(request.most_pass_samples,
               0.5 * (biased_ ? least_biased_growth : least_growth) * so_far.mean_samples);
  return request;
}

/// Samples a pixel that the time left has room for.
double RoundPlanner::affordable_samples(const RoundsSoFar& so_far) const {
  if (!target_.time_s) return std::numeric_limits<double>::infinity();
  const double left_s = *target_.time_s - reserve_s_ - so_far.elapsed_s;
  if (left_s <= time_left_over * *target_.time_s) return 0;
  const double sample_s = so_far.last_pass_s / std::max(so_far.last_pass_samples, 1e-3);
  if (!(sample_s > 0)) return std::numeric_limits<double>::infinity();
  const double samples = left_s / sample_s;
  if (!so_far.last_pass_even) return time_share * samples;
  // The least of rounds has even samples again, and costs what it did.
  return std::max(time_share_at_first * samples, std::min(samples, 2 * least_pass_samples_));
}

}  // namespace tessera
