#pragma once
/// Equal error: how many samples a method needs, and how long it takes for them, to come as near to
/// the reference as another does. Measured at a few sample counts, interpolated between them.

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace tessera {

/// One method at one sample count.
struct LadderStep {
  double spp = 0, rel_mse = 0, seconds = 0;
};

/// A place on a ladder of sample counts.
struct LadderPlace {
  double spp = 0, seconds = 0;
  /// 1: past the ladder's end, whose values these are: a lower bound. -1: before its start, whose
  /// values these are: an upper bound. 0: within.
  int capped = 0;
};

/// Between a and b, the share `at` of the way in logarithms; linear where either is not above 0.
inline double log_mix(double a, double b, double at) {
  if (!(a > 0) || !(b > 0)) return a + (b - a) * at;
  return std::exp(std::log(a) + (std::log(b) - std::log(a)) * at);
}

/// Where `value` lies between a and b in logarithms, in [0, 1].
inline double log_share(double a, double b, double value) {
  constexpr double least = 1e-30;
  const double from = std::log(std::max(a, least)), to = std::log(std::max(b, least));
  if (from == to) return 1;
  return std::clamp((std::log(std::max(value, least)) - from) / (to - from), 0.0, 1.0);
}

/// What lies the share `at` of the way between two steps.
inline LadderPlace between(const LadderStep& a, const LadderStep& b, double at) {
  return {log_mix(a.spp, b.spp, at), log_mix(a.seconds, b.seconds, at), 0};
}

/// The first place where the error has fallen to `target_rel_mse`. Steps are in order of rising
/// sample counts, at least one; their errors need not fall.
inline LadderPlace equal_error(std::span<const LadderStep> ladder, double target_rel_mse) {
  const LadderStep& first = ladder.front();
  if (first.rel_mse <= target_rel_mse) return {first.spp, first.seconds, -1};
  for (size_t k = 1; k < ladder.size(); ++k)
    if (ladder[k].rel_mse <= target_rel_mse)
      return between(ladder[k - 1], ladder[k],
                     log_share(ladder[k - 1].rel_mse, ladder[k].rel_mse, target_rel_mse));
  return {ladder.back().spp, ladder.back().seconds, 1};
}

/// How long `spp` samples a pixel take; past the ladder's end along the line through its last two
/// steps, for nothing but samples grows there.
inline double seconds_of(std::span<const LadderStep> ladder, double spp) {
  if (spp < ladder.front().spp || ladder.size() < 2) return ladder.front().seconds;
  size_t k = 1;
  while (k + 1 < ladder.size() && spp > ladder[k].spp) ++k;
  const LadderStep &a = ladder[k - 1], &b = ladder[k];
  return a.seconds + (b.seconds - a.seconds) * (spp - a.spp) / (b.spp - a.spp);
}

}  // namespace tessera
