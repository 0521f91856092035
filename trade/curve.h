#pragma once
/// Time against error along a ladder of sample counts, and how two such curves compare.

#include <span>
#include <string>
#include <vector>

#include "trade/measurement.h"

namespace tessera::trade {

struct CurvePoint {
  double spp = 0, time_s = 0, rel_mse = 0;
  double spread = 0;  ///< Run::spread() of its time; NaN when that is unknown
};

/// A number read off a curve, or off the ratio of two. Past the ends of a ladder all that is known
/// is a bound.
enum class Bound { exact, at_most, at_least };

struct Reading {
  double value = unknown;
  Bound bound = Bound::exact;
  /// Largest, of the times of the steps that it was read from; relative. NaN when one is unknown.
  double spread = 0;

  bool known() const { return value == value; }
};

/// "0.71", "at least 1.9", "-" when unknown.
std::string text_of(const Reading& reading);

/// The runs of a turn that went well, by rising samples per pixel.
std::vector<CurvePoint> curve_of(const std::vector<Run>& runs, const Turn& turn);

/// The time after which the error has first fallen to `rel_mse`, between two steps of the ladder by
/// interpolation of both logarithms. Before the ladder's start: at most the first time; past its
/// end: at least the last. Steps by rising spp; their errors need not fall. Unknown when empty.
Reading time_to_reach(std::span<const CurvePoint> curve, double rel_mse);

/// The error after `time_s`, likewise. With less time than the ladder's first step takes: at least
/// its error; with more than the last takes: at most that one's.
Reading error_after(std::span<const CurvePoint> curve, double time_s);

/// How a curve fares against another one.
struct Comparison {
  double pivot_spp = 0;  ///< the other's point that it is compared at
  Reading time_ratio;    ///< time to reach the other's error there, over the other's time
  Reading error_ratio;   ///< error after the other's time there, over the other's error
  /// The same of all points of the other whose error lies on this ladder: geometric means.
  Reading time_ratio_ladder, error_ratio_ladder;
  /// Of a ratio of times, relative: root of the summed squares of both spreads; NaN when one is
  /// unknown, as of what was timed once.
  double noise = 0;

  bool noise_known() const { return noise == noise; }
  /// Whether the ratio of times differs from 1 by no more than noise; false when that is unknown.
  bool within_noise() const;
};

/// At the point of `other` whose spp is nearest to `pivot_spp`. Both hold at least one point.
Comparison compare_curves(std::span<const CurvePoint> curve, std::span<const CurvePoint> other,
                          double pivot_spp);

}  // namespace tessera::trade
