#include "trade/words.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "trade/curve.h"

namespace tessera::trade {
namespace {

struct Judged {
  Turn turn;
  Comparison comparison;
};

/// Whether a turn surely reaches the default's error in less time.
bool is_faster(const Judged& judged) {
  const Reading& ratio = judged.comparison.time_ratio;
  return ratio.known() && ratio.bound != Bound::at_least && ratio.value < 1 &&
         std::log(ratio.value) < -std::log1p(judged.comparison.noise);
}

std::string noise_text(const Judged& judged) {
  return fmt::format("repeats vary by {:.0f} %", 100 * judged.comparison.noise);
}

/// "0.71 of the default's time" at the default's error, or what is known of it.
std::string time_sentence(const Judged& judged) {
  const Comparison& c = judged.comparison;
  const std::string name = judged.turn.name();
  const Reading& time = c.time_ratio;
  if (!time.known()) return fmt::format("{}: nothing can be said, its times are unknown.", name);
  if (time.bound == Bound::at_least) {
    const std::string error =
        c.error_ratio.known()
            ? fmt::format("; in the default's time its error is {} times as large",
                          text_of(c.error_ratio))
            : "";
    return fmt::format(
        "{} does not reach the default's error at {} samples within its ladder, "
        "whose end takes {:.3g} times the default's time{}.",
        name, c.pivot_spp, time.value, error);
  }
  if (c.within_noise())
    return fmt::format(
        "{} takes the default's time for its error, within noise ({:.3g} of it; {}).", name,
        time.value, noise_text(judged));
  return fmt::format("{} reaches the default's error at {} samples in {} of its time.", name,
                     c.pivot_spp, text_of(time));
}

std::string samples_sentence(const std::vector<CurvePoint>& curve) {
  if (curve.size() < 2) return "";
  const CurvePoint &first = curve.front(), &last = curve.back();
  if (!(last.rel_mse > 0 && first.rel_mse > 0 && last.spp > first.spp)) return "";
  const double slope = std::log(last.rel_mse / first.rel_mse) / std::log(last.spp / first.spp);
  return fmt::format(
      "Samples: from {} to {} a pixel the default takes {:.3g} times as long and "
      "relMSE falls to 1/{:.3g}, as the power {:.2f} of the samples.",
      first.spp, last.spp, last.time_s / first.time_s, first.rel_mse / last.rel_mse, slope);
}

std::vector<Judged> judge(const WordsInput& input, const std::vector<CurvePoint>& other) {
  std::vector<Judged> list;
  for (const Turn& turn : input.turns) {
    const std::vector<CurvePoint> curve = curve_of(input.runs, turn);
    if (!curve.empty())
      list.push_back({turn, compare_curves(curve, other, double(input.pivot_spp))});
  }
  std::stable_sort(list.begin(), list.end(), [](const Judged& a, const Judged& b) {
    const auto key = [](const Judged& judged) {
      const Reading& ratio = judged.comparison.time_ratio;
      return ratio.known() ? ratio.value * (ratio.bound == Bound::at_least ? 1e9 : 1) : 1e30;
    };
    return key(a) < key(b);
  });
  return list;
}

/// The first sentence about knobs: the one that buys most.
std::string best_sentence(const std::vector<Judged>& list) {
  if (list.empty()) return "";
  const auto best = std::find_if(list.begin(), list.end(), is_faster);
  if (best == list.end())
    return "No knob but spp buys anything here: no value reaches the default's error in less time "
           "than noise explains.";
  return fmt::format("The knob that buys most here is {}: {}", best->turn.knob,
                     time_sentence(*best));
}

std::string front_sentence(const std::vector<Run>& runs) {
  std::string turned;
  bool any = false;
  for (const Run& run : runs) {
    any |= run.pareto;
    if (run.pareto && !run.configuration.turn.is_default())
      turned += (turned.empty() ? "" : ", ") + run.configuration.label();
  }
  if (!any) return "";
  return turned.empty() ? "No knob but spp moves the front: the default alone is on it."
                        : fmt::format("On the front besides the default: {}.", turned);
}

std::string limit_sentence(const WordsInput& input) {
  const auto limited = std::count_if(input.runs.begin(), input.runs.end(),
                                     [](const Run& run) { return run.ok() && run.limited; });
  if (limited == 0) return "";
  return fmt::format(
      "{} runs are limited by the reference, whose own relMSE is {:.2g}: their errors "
      "are less sure; raise --reference-spp to tell them apart.",
      limited, input.reference_rel_mse);
}

}  // namespace

std::vector<std::string> describe_trade(const WordsInput& input) {
  std::vector<std::string> words;
  const auto say = [&words](const std::string& sentence) {
    if (!sentence.empty()) words.push_back(sentence);
  };
  const std::vector<CurvePoint> defaults = curve_of(input.runs, Turn{});
  if (defaults.empty()) {
    say("The default went wrong at every sample count, so that there is nothing to compare with.");
    return words;
  }
  const std::vector<Judged> list = judge(input, defaults);
  say(best_sentence(list));
  say(samples_sentence(defaults));
  say(front_sentence(input.runs));
  const bool best_said = std::any_of(list.begin(), list.end(), is_faster);
  bool skipped = !best_said;
  for (const Judged& judged : list) {
    // The best has had its sentence.
    if (!skipped && is_faster(judged)) {
      skipped = true;
      continue;
    }
    say(time_sentence(judged));
  }
  say(limit_sentence(input));
  if (input.repeats < 2) say("Each time was measured once: nothing is known of their noise.");
  return words;
}

}  // namespace tessera::trade
