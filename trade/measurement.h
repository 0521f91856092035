#pragma once
/// What one process brought, and the row that those of one configuration make together.

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "trade/configuration.h"

namespace tessera::trade {

inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// One process. Numbers that are unknown are NaN.
struct Measurement {
  std::string label;  ///< of its configuration
  std::string id;     ///< of its configuration
  int round = 0;      ///< from 0
  bool ok = false;
  bool stopped = false;  ///< by Ctrl-C or the end of the budget: as if it had not been started
  std::string error;     ///< what a failed run said
  double frame_s = unknown, wall_s = unknown, cpu_s = unknown;
  uint64_t peak_bytes = 0, rays = 0, shaded_points = 0, samples = 0;
  double ste = unknown;  ///< samples covered over samples tested, in [0, 1]
  double rmse = unknown, rel_mse = unknown;
  double visible = unknown;  ///< share of pixels where the difference is seen, in [0, 1]
  std::string pixels;        ///< hash of the image

  nlohmann::ordered_json json() const;
  /// Throws Error when a member is missing or of another type.
  static Measurement from_json(const nlohmann::ordered_json& json);
};

/// A configuration and everything its processes brought. Times are medians.
struct Run {
  Configuration configuration;
  bool measured = false;  ///< at least one process ended
  Measurement result;     ///< counts and errors of the first, medians of times, largest memory
  std::vector<double> frame_s_all;
  /// "repeat 2: what it said", of a repeat that failed and never went well; empty: there is none.
  std::string failed_repeat;
  bool pareto = false;   ///< no other run is as good in time and error and better in one
  bool limited = false;  ///< its error is near that of the reference

  bool ok() const { return measured && result.ok; }
  /// Half of what the frame times of the repeats span, over their median; unknown with fewer than
  /// two.
  double spread() const;
};

/// Of at least one value. Of an even number, the mean of the two in the middle.
double median(std::vector<double> values);

/// One run for each configuration, in their order. Repeats that went well make it, whatever others
/// did: a failure counts only where the first round, which measures the errors, never went well.
/// Runs whose repeats differ in a bit are failed runs.
std::vector<Run> gather_runs(const std::vector<Configuration>& configurations,
                             const std::vector<Measurement>& measurements);

}  // namespace tessera::trade
