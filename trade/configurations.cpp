#include "trade/configurations.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace tessera::trade {
namespace {

constexpr const char* qualities[] = {"draft", "preview", "final"};

class Lister {
 public:
  explicit Lister(const SweepRequest& request) : request_(request) {
    const int scene_spp = std::atoi(request.plan.text("samples_per_pixel").c_str());
    if (scene_spp > 0) list_.scene_spp = scene_spp;
    list_.pivot_spp = std::clamp(list_.scene_spp, request.ladder.front(), request.ladder.back());
  }

  SweepList list() {
    add(Turn{}, default_ladder(request_.ladder, list_.pivot_spp));
    for (const KnobChoice& choice : request_.knobs) add_knob(choice);
    if (request_.qualities) add_qualities();
    for (const Baseline& baseline : request_.baselines) add_baseline(baseline);
    return std::move(list_);
  }

 private:
  void add(const Turn& turn, const std::vector<int>& ladder);
  void add_knob(const KnobChoice& choice);
  void add_qualities();
  void add_baseline(const Baseline& baseline);
  std::string reason_against(const Knob& knob) const;

  const SweepRequest& request_;
  SweepList list_;
};

/// Adds a turn at each sample count; 0 samples: as the turn itself says.
void Lister::add(const Turn& turn, const std::vector<int>& ladder) {
  for (const int spp : ladder) {
    Configuration configuration;
    configuration.turn = turn;
    configuration.spp = spp;
    if (spp > 0) configuration.options = {"--spp", std::to_string(spp)};
    for (const std::string& option : options_of(turn)) configuration.options.push_back(option);
    const auto known = [&configuration](const Configuration& other) {
      return other.label() == configuration.label();
    };
    std::vector<Configuration>& all = list_.configurations;
    if (std::none_of(all.begin(), all.end(), known)) all.push_back(std::move(configuration));
  }
}

/// Why a knob is left out; empty: it is not.
std::string Lister::reason_against(const Knob& knob) const {
  if (!request_.has_option(knob.option))
    return fmt::format("this renderer has no option {}", knob.option);
  const auto& common = request_.common;
  if (std::find(common.begin(), common.end(), knob.option) != common.end())
    return fmt::format("{} is given for all runs", knob.option);
  return knob.idle ? knob.idle(request_.plan) : "";
}

void Lister::add_knob(const KnobChoice& choice) {
  const Knob& knob = *choice.knob;
  if (knob.name == "spp") return;
  const std::string reason = reason_against(knob);
  if (!reason.empty()) {
    list_.notes.push_back(fmt::format("{} is left out: {}", knob.name, reason));
    return;
  }
  for (const std::string& value : choice.values) {
    if (value == default_of(knob, request_.plan)) continue;
    const Turn turn{knob.name, value};
    if (std::find(list_.turns.begin(), list_.turns.end(), turn) == list_.turns.end())
      list_.turns.push_back(turn);
    add(turn, request_.ladder);
  }
}

void Lister::add_qualities() {
  const std::string reason = reason_against(find_knob("quality"));
  if (!reason.empty()) {
    list_.notes.push_back(fmt::format("quality is left out: {}", reason));
    return;
  }
  for (const char* quality : qualities) {
    list_.turns.push_back({"quality", quality});
    add({"quality", quality}, {0});
  }
}

void Lister::add_baseline(const Baseline& baseline) {
  const Knob& knob = find_knob(baseline.turn.knob);
  std::string reason = reason_against(knob);
  if (reason.empty() && baseline.turn.value == default_of(knob, request_.plan))
    reason = "it is the default here";
  if (!reason.empty()) {
    list_.missing_baselines.push_back(fmt::format("{} is left out: {}", baseline.name, reason));
    return;
  }
  for (const Baseline& other : list_.baselines)
    if (other.name == baseline.name) return;
  list_.baselines.push_back(baseline);
  // The pivot too: the table gives everybody's numbers at the scene's own samples.
  std::vector<int> ladder = request_.ladder;
  if (std::find(ladder.begin(), ladder.end(), list_.pivot_spp) == ladder.end()) {
    ladder.push_back(list_.pivot_spp);
    std::sort(ladder.begin(), ladder.end());
  }
  add(baseline.turn, ladder);
}

}  // namespace

std::vector<int> default_ladder(const std::vector<int>& ladder, int pivot_spp) {
  std::vector<int> all = ladder;
  for (size_t k = 1; k < ladder.size(); ++k)
    all.push_back(int(std::lround(std::sqrt(double(ladder[k - 1]) * double(ladder[k])))));
  all.push_back(pivot_spp);
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

std::string default_of(const Knob& knob, const ScenePlan& plan) {
  return knob.plan_entry.empty() ? knob.default_value : plan.text(knob.plan_entry);
}

SweepList list_configurations(const SweepRequest& request) { return Lister(request).list(); }

}  // namespace tessera::trade
