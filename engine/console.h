#pragma once
/// Where the commands print: results, warnings, errors and the progress bar, which must not run
/// into each other.

#include <chrono>
#include <cstdio>
#include <mutex>
#include <optional>
#include <string>

#include "engine/progress.h"

namespace tessera {

enum class Verbosity { quiet, normal, verbose };

/// Thread safe. Results go to standard output, everything else to standard error. A line is given
/// without its line end. Streams that are full or closed are no error here.
class Console {
 public:
  explicit Console(Verbosity verbosity);

  bool verbose() const { return verbosity_ == Verbosity::verbose; }

  /// What was asked for; nothing when quiet.
  void print(const std::string& line);
  /// What the user should know; nothing when quiet.
  void note(const std::string& line);
  /// "error: LINE", always.
  void error(const std::string& line);

  /// Starts a progress bar; nothing when quiet.
  void begin_progress(const std::string& label);
  void progress(const FrameProgress& progress);
  void end_progress();

 private:
  using Clock = std::chrono::steady_clock;

  void write(std::FILE* stream, const std::string& text);

  Verbosity verbosity_;
  bool terminal_;
  std::mutex mutex_;
  std::optional<ProgressMeter> meter_;
  Clock::time_point progress_start_;
  std::string bar_;  ///< what of the bar is on the screen now
};

}  // namespace tessera
