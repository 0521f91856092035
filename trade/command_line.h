#pragma once
/// What the user asks for.

#include <optional>
#include <string>
#include <vector>

#include "trade/knobs.h"

namespace tessera::trade {

struct TradeOptions {
  std::string scene;
  std::string output;  ///< folder
  std::vector<KnobChoice> knobs;
  std::vector<int> ladder;
  std::vector<Baseline> baselines;
  bool qualities = false;
  int repeats = 3;
  std::optional<double> budget_s;
  double timeout_s = 600;
  std::string reference;             ///< a given image; empty: it is rendered
  std::optional<int> reference_spp;  ///< unset: 16 times the largest of the ladder
  std::string cache;                 ///< folder of references
  bool resume = false, fresh = false;
  std::string report;               ///< folder; empty: no page
  std::vector<std::string> tables;  ///< files of benchmarks' rows to show on the page
  std::vector<std::string> common;  ///< options of every run and of the reference
};

/// Reads the command line. Returns no options when there is nothing to run, with the exit code
/// in `exit_code`: after --help, or a line that was not understood, which it prints.
std::optional<TradeOptions> parse_command_line(int argc, const char* const* argv, int& exit_code);

/// $XDG_CACHE_HOME/tessera, or ~/.cache/tessera.
std::string default_cache();

}  // namespace tessera::trade
