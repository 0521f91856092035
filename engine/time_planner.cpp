#include "engine/time_planner.h"

#include <algorithm>
#include <iterator>

namespace tessera {
namespace {

/// Shares of the time left that the second, the third and each further pass take. The better a
/// pass is known from the one before, the more of the time it can have.
constexpr double shares[] = {0.08, 0.45, 0.85};

/// Share of the time asked for that is not worth another pass.
constexpr double time_left_over = 0.05;

constexpr int replacing_growth = 6;

}  // namespace

bool replaces_what_was_before(int samples, int before) {
  return samples > replacing_growth * before;
}

std::optional<int> TimePlanner::next(const TimedPass& last) {
  const double share = shares[std::min<size_t>(size_t(passes_), std::size(shares) - 1)];
  ++passes_, samples_ += last.samples;
  const double left_s = time_s_ - reserve_s_ - last.elapsed_s;
  const double fits = left_s * last.samples / std::max(last.seconds, 1e-9);
  const auto whole = [&](double samples) {
    return int(std::min(samples, double(most_ - samples_)) / unit_) * unit_;
  };
  if (left_s <= time_left_over * time_s_ || whole(fits) < unit_) return std::nullopt;
  // Too few for a share still fit as a whole.
  return std::max(whole(share * fits), unit_);
}

}  // namespace tessera
