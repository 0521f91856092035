#pragma once
/// The order in which a sweep runs its configurations, and where it ends.

#include <functional>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "trade/linear_cost.h"
#include "trade/measurement.h"

namespace tessera::trade {

/// Runs one configuration once, for at most `limit_s` seconds; keeps what it measured.
using Runner = std::function<Measurement(const Configuration&, int round, double limit_s)>;
/// Seconds since some moment.
using Clock = std::function<double()>;

struct SweepSettings {
  int repeats = 3;
  /// When the sweep has to be over, by the clock.
  double end_s = std::numeric_limits<double>::infinity();
  /// Of a frame of the default configuration at `probe_spp` samples, to predict others from.
  double probe_wall_s = 0;
  int probe_spp = 1;

  bool has_budget() const { return end_s < std::numeric_limits<double>::infinity(); }
};

struct SweepOutcome {
  std::vector<Measurement> measurements;  ///< those of before and the new ones
  std::vector<std::string> left_out;      ///< labels of configurations that did not fit at all
  int fewer_repeats = 0;                  ///< configurations that had fewer repeats than asked for
  bool cancelled = false;
};

/// Predicts how long a process takes: as long as it took, or as one of its turn took, or one of the
/// default, times what the default takes longer for as many samples.
class CostModel {
 public:
  CostModel(double probe_wall_s, int probe_spp);
  void add(const Configuration& configuration, double wall_s);
  double predict_s(const Configuration& configuration) const;

 private:
  double growth(int from_spp, int to_spp) const;

  std::map<std::string, double> by_label_;
  std::map<std::string, Pilot> by_turn_;
  std::map<int, double> default_wall_s_;  ///< by samples per pixel
};

/// The order of a round: shuffled, the same way for the same round, so that what
/// drifts with time (heat, other programs) does not go with any knob.
std::vector<size_t> shuffled_order(size_t count, int round);

/// Round by round, each configuration once in each. With a budget the first round goes from what is
/// predicted to be cheap to what is dear, shuffled among what costs nearly the same, and nothing is
/// started that is predicted not to fit.
/// Configurations that failed are not repeated. What went well in `before` is not run again; what
/// failed there is.
SweepOutcome sweep(const std::vector<Configuration>& configurations, const SweepSettings& settings,
                   const std::vector<Measurement>& before, const Runner& runner, const Clock& clock,
                   const std::function<bool()>& cancelled);

}  // namespace tessera::trade
