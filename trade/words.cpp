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

/// Whether a turn reached the default's error in less time, be it by chance.
bool looks_faster(const Judged& judged) {
  const Reading& ratio = judged.comparison.time_ratio;
  return ratio.known() && ratio.bound != Bound::at_least && ratio.value < 1;
}

/// Whether it surely does: not where nothing is known of the noise.
bool is_faster(const Judged& judged) {
  return looks_faster(judged) && judged.comparison.noise_known() &&
         std::log(judged.comparison.time_ratio.value) < -std::log1p(judged.comparison.noise);
}

/// Whether more repeats, or more samples, might show that it is: its time is of one run, or it took
/// less time so far and has not come to the default's error.
bool is_open(const Judged& judged) {
  const Reading& ratio = judged.comparison.time_ratio;
  if (ratio.known() && ratio.bound == Bound::at_least) return ratio.value < 1;
  return looks_faster(judged) && !judged.comparison.noise_known();
}

/// "0.71 of", "2.4 times", "at least 2 times": a share of the default's time, or a multiple.
std::string share_of_time(const Reading& ratio) {
  return ratio.value < 1 ? text_of(ratio) + " of" : text_of(ratio) + " times";
}

/// A preset has one point: its own place says more than a ladder's.
std::string preset_sentence(const WordsInput& input, const Judged& judged) {
  const CurvePoint point = curve_of(input.runs, judged.turn).front();
  const Reading time = time_to_reach(curve_of(input.runs, Turn{}), point.rel_mse);
  return fmt::format("{} takes {:.3g} s for a relMSE of {:.3g}, for which the default takes {} s.",
                     judged.turn.name(), point.time_s, point.rel_mse, text_of(time));
}

/// What a turn takes to reach the default's error, or what is known of it.
std::string time_sentence(const WordsInput& input, const Judged& judged) {
  const Comparison& c = judged.comparison;
  const std::string name = judged.turn.name();
  const Reading& time = c.time_ratio;
  if (judged.turn.knob == "quality") return preset_sentence(input, judged);
  if (!time.known()) return fmt::format("{}: nothing can be said, its times are unknown.", name);
  if (time.bound == Bound::at_least)
    return fmt::format(
        "{} does not come to the default's error at {} samples within its ladder, whose end takes "
        "{} the default's time; after the default's time its relMSE is {} times the default's.",
        name, c.pivot_spp, share_of_time({time.value}), text_of(c.error_ratio));
  if (c.within_noise())
    return fmt::format(
        "{} takes as long as the default for its error, within noise: {:.3g} of its "
        "time, known to {:.0f} %.",
        name, time.value, 100 * c.noise);
  const std::string ladder = c.time_ratio_ladder.known() ? fmt::format(" ({} over the ladder)",
                                                                       text_of(c.time_ratio_ladder))
                                                         : "";
  return fmt::format("{} {} the default's error at {} samples in {} its time{}{}.", name,
                     c.noise_known() ? "reaches" : "reached", c.pivot_spp, share_of_time(time),
                     ladder, c.noise_known() ? "" : ", timed once: that may be noise");
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

/// Where more samples hardly lower the error any more, what is left is no noise.
std::string bias_sentence(const std::vector<CurvePoint>& curve) {
  constexpr double stalled = -0.25;  // noise alone falls with the power -1
  if (curve.size() < 2) return "";
  const CurvePoint &a = curve[curve.size() - 2], &b = curve.back();
  if (!(a.rel_mse > 0 && b.rel_mse > 0 && b.spp > a.spp)) return "";
  const double slope = std::log(b.rel_mse / a.rel_mse) / std::log(b.spp / a.spp);
  if (slope < stalled) return "";
  return fmt::format(
      "From {} to {} samples the default's relMSE goes from {:.3g} to {:.3g} only: "
      "what is left is not noise but what shading, dicing or filtering leave out, "
      "and more samples do not bring it.",
      a.spp, b.spp, a.rel_mse, b.rel_mse);
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

/// The first sentence about knobs: the one that buys most, if that can be said.
std::string best_sentence(const WordsInput& input, const std::vector<Judged>& list) {
  if (list.empty()) return "";
  const auto best = std::find_if(list.begin(), list.end(), is_faster);
  const bool open = std::any_of(list.begin(), list.end(), is_open);
  if (best != list.end())
    return fmt::format("The knob that buys most here{} is {}: {}",
                       open ? ", of what is known well enough," : "", best->turn.knob,
                       time_sentence(input, *best));
  if (open)
    return "Whether a knob but spp buys anything here cannot be said: values that took less time "
           "than "
           "the default were timed once, or the default was, or they were not run with samples "
           "enough "
           "for its error. More --repeats or more --budget tell.";
  return "No knob but spp buys anything here: no value reaches the default's error in less time "
         "than noise explains.";
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
      "Runs limited by the reference, whose own relMSE is {:.2g}: {}. Their errors are less sure; "
      "raise --reference-spp to tell them apart.",
      input.reference_rel_mse, limited);
}

std::string repeats_sentence(const std::vector<Run>& runs) {
  const auto once = std::count_if(runs.begin(), runs.end(), [](const Run& run) {
    return run.ok() && run.frame_s_all.size() < 2;
  });
  if (once == 0) return "";
  return fmt::format(
      "Runs timed once: {}. Nothing is known of their noise, and what rests on them may be noise.",
      once);
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
  say(best_sentence(input, list));
  say(samples_sentence(defaults));
  say(bias_sentence(defaults));
  say(front_sentence(input.runs));
  const bool best_said = std::any_of(list.begin(), list.end(), is_faster);
  bool skipped = !best_said;
  for (const Judged& judged : list) {
    // The best has had its sentence.
    if (!skipped && is_faster(judged)) {
      skipped = true;
      continue;
    }
    say(time_sentence(input, judged));
  }
  say(limit_sentence(input));
  say(repeats_sentence(input.runs));
  return words;
}

}  // namespace tessera::trade
