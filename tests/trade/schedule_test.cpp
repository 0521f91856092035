// Sweeps with a clock and a runner made up: no process is started.

#include <algorithm>
#include <map>
#include <set>

#include <catch2/catch.hpp>

#include "tests/trade/trade_fixtures.h"
#include "trade/schedule.h"

using namespace tessera::trade;

namespace {

// Processes that take a known time on a clock of their own, and may fail or be interrupted.
class FakeMachine {
 public:
  std::map<std::string, double> cost_s;  // by label; 1 where there is none
  std::set<std::string> failing;
  int cancel_after = 1 << 30;
  std::vector<std::pair<std::string, int>> started;
  double now_s = 0;

  SweepOutcome sweep(const std::vector<Configuration>& all, const SweepSettings& settings,
                     const std::vector<Measurement>& before = {}) {
    return tessera::trade::sweep(
        all, settings, before,
        [this](const Configuration& c, int round, double limit_s) {
          return run(c, round, limit_s);
        },
        [this] { return now_s; }, [this] { return int(started.size()) >= cancel_after; });
  }

 private:
  Measurement run(const Configuration& c, int round, double limit_s) {
    started.emplace_back(c.label(), round);
    const double cost = cost_s.count(c.label()) ? cost_s[c.label()] : 1;
    now_s += std::min(cost, limit_s);
    Measurement m = measurement(c.label(), round, cost, 1);
    m.stopped = cost > limit_s;
    m.ok = !failing.count(c.label());
    return m;
  }
};

std::vector<Configuration> some_configurations() {
  return {configuration({}, 4), configuration({}, 16), configuration({"hider", "bbox"}, 4),
          configuration({"hider", "bbox"}, 16)};
}

}  // namespace

TEST_CASE("every configuration runs once in each round, in another order") {
  FakeMachine machine;
  SweepSettings settings;
  settings.repeats = 5;
  const auto all = some_configurations();
  const SweepOutcome outcome = machine.sweep(all, settings);
  CHECK(outcome.measurements.size() == 20);
  CHECK(outcome.left_out.empty());
  std::set<std::vector<std::string>> orders;
  for (int round = 0; round < 5; ++round) {
    std::vector<std::string> order;
    for (int i = 0; i < 4; ++i) {
      CHECK(machine.started[size_t(4 * round + i)].second == round);
      order.push_back(machine.started[size_t(4 * round + i)].first);
    }
    orders.insert(order);
    CHECK(std::set<std::string>(order.begin(), order.end()).size() == 4);
  }
  CHECK(orders.size() > 1);
  FakeMachine again;
  again.sweep(all, settings);
  CHECK(again.started == machine.started);
}

TEST_CASE("a budget takes the cheap before the dear and starts nothing that cannot fit") {
  FakeMachine machine;
  machine.cost_s = {
      {"spp=4", 1}, {"spp=16", 4}, {"hider=bbox spp=4", 3}, {"hider=bbox spp=16", 12}};
  SweepSettings settings;
  settings.repeats = 3;
  settings.end_s = 15;
  settings.probe_wall_s = 4;
  settings.probe_spp = 16;
  const SweepOutcome outcome = machine.sweep(some_configurations(), settings);
  // 1 + 3 + 4 = 8 s; boxes at 16 samples are predicted to take 12 s of the 7 that are left.
  REQUIRE(machine.started.size() >= 3);
  // Both of 4 samples are predicted to take as long at first.
  CHECK(std::set<std::string>{machine.started[0].first, machine.started[1].first} ==
        std::set<std::string>{"spp=4", "hider=bbox spp=4"});
  CHECK(machine.started[2].first == "spp=16");
  CHECK(outcome.left_out == std::vector<std::string>{"hider=bbox spp=16"});
  CHECK(outcome.fewer_repeats > 0);
  CHECK(std::none_of(machine.started.begin(), machine.started.end(),
                     [](const auto& start) { return start.first == "hider=bbox spp=16"; }));
  CHECK(machine.now_s <= settings.end_s);
  // What was left went to repeats.
  CHECK(machine.started.size() > 3);
}

TEST_CASE("within a budget, too, time goes with no knob: what costs as much is shuffled") {
  std::vector<Configuration> all;
  for (const int spp : {1, 2, 4, 8, 16, 32})
    for (const Turn& turn : {Turn{}, Turn{"hider", "a"}, Turn{"hider", "b"}, Turn{"hider", "c"}})
      all.push_back(configuration(turn, spp));
  FakeMachine machine, again;
  for (const Configuration& c : all) machine.cost_s[c.label()] = 0.1 * c.spp;
  again.cost_s = machine.cost_s;
  SweepSettings settings;
  settings.repeats = 1;
  settings.end_s = 1e6;
  settings.probe_wall_s = 1.6;
  settings.probe_spp = 16;
  machine.sweep(all, settings);
  again.sweep(all, settings);
  CHECK(machine.started == again.started);
  REQUIRE(machine.started.size() == all.size());
  std::map<std::string, size_t> place;
  for (size_t i = 0; i < all.size(); ++i) place[machine.started[i].first] = i;
  int default_first = 0;
  for (size_t step = 0; step < all.size(); step += 4) {
    // Each step of the ladder is over before the next begins.
    for (size_t i = step; i < step + 4; ++i) CHECK(place[all[i].label()] / 4 == step / 4);
    default_first += place[all[step].label()] == step;
  }
  CHECK(default_first < 6);
}

TEST_CASE("what takes longer than predicted is given up at the end, as if not started") {
  FakeMachine machine;
  const std::vector<Configuration> all{configuration({}, 4), configuration({}, 16),
                                       configuration({"hider", "bbox"}, 4),
                                       configuration({"hider", "bbox"}, 64)};
  machine.cost_s = {
      {"spp=4", 0.25}, {"spp=16", 1}, {"hider=bbox spp=4", 0.25}, {"hider=bbox spp=64", 1000}};
  SweepSettings settings;
  settings.repeats = 1;
  settings.end_s = 50;
  settings.probe_wall_s = 1;
  settings.probe_spp = 16;
  const SweepOutcome outcome = machine.sweep(all, settings);
  CHECK(machine.now_s <= 50);
  CHECK(outcome.measurements.size() == 3);
  CHECK(outcome.left_out == std::vector<std::string>{"hider=bbox spp=64"});
  CHECK_FALSE(outcome.cancelled);
}

TEST_CASE("failed configurations are not repeated and do not end the sweep") {
  FakeMachine machine;
  machine.failing.insert("spp=16");
  SweepSettings settings;
  const SweepOutcome outcome = machine.sweep(some_configurations(), settings);
  CHECK(std::count_if(machine.started.begin(), machine.started.end(),
                      [](const auto& start) { return start.first == "spp=16"; }) == 1);
  CHECK(outcome.measurements.size() == 3 * 3 + 1);
}

TEST_CASE("an interrupted sweep goes on where it was, and nothing runs twice") {
  FakeMachine whole, first, second;
  const auto all = some_configurations();
  const SweepSettings settings;
  whole.sweep(all, settings);
  first.cancel_after = 5;
  const SweepOutcome half = first.sweep(all, settings);
  CHECK(half.cancelled);
  CHECK(half.measurements.size() == 5);
  const SweepOutcome rest = second.sweep(all, settings, half.measurements);
  CHECK_FALSE(rest.cancelled);
  CHECK(rest.measurements.size() == 12);
  std::vector<std::pair<std::string, int>> both = first.started;
  both.insert(both.end(), second.started.begin(), second.started.end());
  CHECK(both == whole.started);
}

TEST_CASE("what failed before is tried again, once, and what went well is not") {
  const auto all = some_configurations();
  SweepSettings settings;
  settings.repeats = 2;
  FakeMachine first, second, third;
  first.failing = {"spp=4", "spp=16"};
  const SweepOutcome before = first.sweep(all, settings);
  second.failing = {"spp=16"};
  const SweepOutcome after = second.sweep(all, settings, before.measurements);
  std::multiset<std::pair<std::string, int>> started(second.started.begin(), second.started.end());
  CHECK(started ==
        std::multiset<std::pair<std::string, int>>{{"spp=4", 0}, {"spp=4", 1}, {"spp=16", 0}});
  const std::vector<Run> runs = gather_runs(all, after.measurements);
  CHECK(runs[0].ok());
  CHECK_FALSE(runs[1].ok());
  third.sweep(all, settings, after.measurements);
  CHECK(third.started == std::vector<std::pair<std::string, int>>{{"spp=16", 0}, {"spp=16", 1}});
}

TEST_CASE("costs are predicted from what is nearest") {
  CostModel costs(2, 16);
  const auto all = some_configurations();
  CHECK(costs.predict_s(all[0]) == Approx(0.5));
  CHECK(costs.predict_s(all[3]) == Approx(2.0));
  costs.add(all[2], 3);
  CHECK(costs.predict_s(all[3]) == Approx(12.0));
  CHECK(costs.predict_s(all[2]) == 3);
  CHECK(costs.predict_s(all[1]) == Approx(2.0));
  // The default takes 1 s whatever its samples and 1/16 s for each: boxes take as many times that
  // at 16 as at 4 samples.
  costs.add(all[0], 1.25);
  CHECK(costs.predict_s(all[3]) == Approx(3 * 2 / 1.25));
}
