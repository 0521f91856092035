#include "trade/schedule.h"

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

#include "base/hash.h"

namespace tessera::trade {
namespace {

class Sweep {
 public:
  Sweep(const std::vector<Configuration>& configurations, const SweepSettings& settings,
        const std::vector<Measurement>& before, const Runner& runner, const Clock& clock,
        const std::function<bool()>& cancelled)
      : configurations_(configurations),
        settings_(settings),
        runner_(runner),
        clock_(clock),
        cancelled_(cancelled),
        costs_(settings.probe_wall_s, settings.probe_spp) {
    outcome_.measurements = before;
    // What failed may go well now: with more time, more room on the disc, another machine's memory.
    for (const Measurement& measurement : before)
      if (measurement.ok) note(measurement);
    for (const Configuration& configuration : configurations)
      for (const Measurement& measurement : before)
        if (measurement.ok && measurement.label == configuration.label())
          costs_.add(configuration, measurement.wall_s);
  }

  SweepOutcome run() {
    for (int round = 0; round < settings_.repeats && !outcome_.cancelled; ++round) {
      if (round == 0 && settings_.has_budget()) {
        cheapest_first();
      } else {
        for (const size_t i : shuffled_order(configurations_.size(), round))
          if (wanted(configurations_[i], round) && !try_run(configurations_[i], round)) break;
      }
    }
    count_what_is_missing();
    return std::move(outcome_);
  }

 private:
  void note(const Measurement& measurement) {
    done_.insert({measurement.label, measurement.round});
    if (!measurement.ok) failed_.insert(measurement.label);
  }
  bool wanted(const Configuration& configuration, int round) const {
    return !failed_.count(configuration.label()) && !done_.count({configuration.label(), round});
  }
  /// False when the sweep is cancelled. What does not fit is passed over.
  bool try_run(const Configuration& configuration, int round);
  void cheapest_first();
  void count_what_is_missing();

  const std::vector<Configuration>& configurations_;
  const SweepSettings& settings_;
  const Runner& runner_;
  const Clock& clock_;
  const std::function<bool()>& cancelled_;
  CostModel costs_;
  std::set<std::pair<std::string, int>> done_;
  std::set<std::string> failed_;
  SweepOutcome outcome_;
};

bool Sweep::try_run(const Configuration& configuration, int round) {
  if (cancelled_()) {
    outcome_.cancelled = true;
    return false;
  }
  const double left_s = settings_.end_s - clock_();
  if (costs_.predict_s(configuration) > left_s) return true;
  Measurement measurement = runner_(configuration, round, left_s);
  if (measurement.stopped) {
    outcome_.cancelled = cancelled_();
    return !outcome_.cancelled;
  }
  if (measurement.ok) costs_.add(configuration, measurement.wall_s);
  note(measurement);
  outcome_.measurements.push_back(std::move(measurement));
  return true;
}

/// Chosen anew each time: predictions grow better with what was measured. Among those that are
/// nearly as cheap as the cheapest the shuffled order decides, so that what drifts with time does
/// not go with any knob here either.
void Sweep::cheapest_first() {
  constexpr double nearly = 1.5;
  std::vector<const Configuration*> waiting;
  for (const size_t i : shuffled_order(configurations_.size(), 0))
    if (wanted(configurations_[i], 0)) waiting.push_back(&configurations_[i]);
  while (!waiting.empty()) {
    std::vector<double> cost_s;
    for (const Configuration* one : waiting) cost_s.push_back(costs_.predict_s(*one));
    const double most_s = nearly * *std::min_element(cost_s.begin(), cost_s.end());
    size_t next = 0;
    while (!(cost_s[next] <= most_s)) ++next;
    const Configuration& configuration = *waiting[next];
    waiting.erase(waiting.begin() + std::ptrdiff_t(next));
    if (!try_run(configuration, 0)) return;
  }
}

void Sweep::count_what_is_missing() {
  for (const Configuration& configuration : configurations_) {
    const std::string label = configuration.label();
    if (failed_.count(label)) continue;
    int done = 0;
    for (int round = 0; round < settings_.repeats; ++round)
      done += int(done_.count({label, round}));
    if (done == 0) outcome_.left_out.push_back(label);
    outcome_.fewer_repeats += done > 0 && done < settings_.repeats;
  }
}

}  // namespace

CostModel::CostModel(double probe_wall_s, int probe_spp) {
  by_turn_["default"] = {std::max(probe_spp, 1), probe_wall_s};
  default_wall_s_[std::max(probe_spp, 1)] = probe_wall_s;
}

void CostModel::add(const Configuration& configuration, double wall_s) {
  const int spp = std::max(configuration.spp, 1);
  by_label_[configuration.label()] = wall_s;
  by_turn_[configuration.turn.name()] = {spp, wall_s};
  if (configuration.turn.is_default()) default_wall_s_[spp] = wall_s;
}

/// What the default takes with some samples over what it takes with others.
double CostModel::growth(int from_spp, int to_spp) const {
  const auto &first = *default_wall_s_.begin(), &last = *default_wall_s_.rbegin();
  const LinearCost cost = LinearCost::from({first.first, first.second}, {last.first, last.second});
  const double from_s = cost.of(from_spp);
  return from_s > 0 ? cost.of(to_spp) / from_s : double(to_spp) / double(from_spp);
}

double CostModel::predict_s(const Configuration& configuration) const {
  if (const auto same = by_label_.find(configuration.label()); same != by_label_.end())
    return same->second;
  auto known = by_turn_.find(configuration.turn.name());
  if (known == by_turn_.end()) known = by_turn_.find("default");
  const int spp = configuration.spp > 0 ? configuration.spp : known->second.spp;
  return known->second.wall_s * growth(known->second.spp, spp);
}

std::vector<size_t> shuffled_order(size_t count, int round) {
  std::vector<size_t> order(count);
  std::iota(order.begin(), order.end(), size_t(0));
  std::stable_sort(order.begin(), order.end(), [round](size_t a, size_t b) {
    return hash_combine(uint32_t(round), uint32_t(a)) < hash_combine(uint32_t(round), uint32_t(b));
  });
  return order;
}

SweepOutcome sweep(const std::vector<Configuration>& configurations, const SweepSettings& settings,
                   const std::vector<Measurement>& before, const Runner& runner, const Clock& clock,
                   const std::function<bool()>& cancelled) {
  return Sweep(configurations, settings, before, runner, clock, cancelled).run();
}

}  // namespace tessera::trade
