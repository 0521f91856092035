#pragma once
/// What a frame is rendered to, where that is no number of samples.

#include <optional>
#include <vector>

namespace tessera {

class Diagnostics;
struct Settings;

/// What is asked for. Nothing: a frame of one pass.
struct AccuracyTarget {
  std::optional<double> error;   ///< root of the relative mean square error; above 0
  std::optional<double> time_s;  ///< for the whole frame
  double max_samples = 1024;     ///< mean samples a pixel
  std::vector<double> rounds;    ///< as Settings::rounds; excludes the others
  std::vector<int> passes;       ///< as Settings::passes; excludes the others

  /// Passes of even samples, and as many as a time takes.
  bool even_passes() const { return (time_s && !error) || !passes.empty(); }
  bool several_passes() const { return error || !rounds.empty() || even_passes(); }
};

/// What the settings ask for. Throws Error when it makes no sense.
AccuracyTarget accuracy_target(const Settings& settings);

/// Warns when a frame took so much longer than the time it was given that it should be known.
/// `samples`: a pixel, their mean.
void warn_if_late(const AccuracyTarget& target, double elapsed_s, double samples,
                  Diagnostics& diagnostics);

}  // namespace tessera
