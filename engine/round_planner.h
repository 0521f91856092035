#pragma once
/// When a frame that is rendered to an error has had enough, and what the next round may cost.
/// Knows neither frames nor clocks: it is told what rounds took.

#include <optional>

#include "engine/accuracy_target.h"

namespace tessera {

/// How far the frame is.
struct RoundsSoFar {
  double mean_samples = 0;       ///< a pixel, of all passes
  double error_squared = 0;      ///< as estimated
  double elapsed_s = 0;          ///< since the frame began
  double last_pass_s = 0;        ///< what the last pass took
  double last_pass_samples = 0;  ///< its mean samples a pixel
  bool last_pass_even = true;    ///< the same number in all of them, which is cheaper
};

/// What a round is for: no more samples than bring its own squared error down to `error_squared`,
/// unless these are fewer than `least_pass_samples` a pixel in each of its two passes, and none
/// beyond `most_pass_samples`.
struct RoundRequest {
  double error_squared = 0;
  double least_pass_samples = 0, most_pass_samples = 0;
};

enum class RoundsEnd { none, error_reached, samples_spent, time_spent, repeated };

class RoundPlanner {
 public:
  /// `target` has an error, and perhaps a time, or rounds. `least_pass_samples`: what a pass costs
  /// at least, samples a pixel. `reserve_s`: what is left to do after the last round. `biased`:
  /// rounds have an error in common that the mean of them does not lessen.
  RoundPlanner(const AccuracyTarget& target, double least_pass_samples, double reserve_s,
               bool biased = false);

  /// Samples a pixel of each pass of the first round: a power of two.
  double first_pass_samples() const;
  /// Null at the end; end() says why.
  std::optional<RoundRequest> next(const RoundsSoFar& so_far);
  RoundsEnd end() const { return end_; }

 private:
  double affordable_samples(const RoundsSoFar& so_far) const;

  AccuracyTarget target_;
  double least_pass_samples_, reserve_s_;
  size_t rounds_begun_ = 1;  // the first asks for nothing
  bool biased_;
  RoundsEnd end_ = RoundsEnd::none;
};

}  // namespace tessera
