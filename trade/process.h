#pragma once
/// Programs run one at a time, as from a shell, with what they took of time and memory.

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

namespace tessera::trade {

struct ProcessLimits {
  double timeout_s = 1e30;                    ///< the process is killed after this
  const std::atomic<bool>* cancel = nullptr;  ///< ... and when this turns true
};

struct ProcessResult {
  int exit_code = 0;  ///< when no signal ended it
  int signal = 0;     ///< that ended it; 0: none
  bool timed_out = false, cancelled = false;
  double wall_s = 0, cpu_s = 0;  ///< cpu: user and system, all threads
  uint64_t peak_bytes = 0;       ///< most memory resident at once
  std::string output;            ///< standard output and error, as they came

  bool ok() const { return exit_code == 0 && signal == 0 && !timed_out && !cancelled; }
  /// What went wrong, in one line: what the program said, or how it ended.
  std::string failure() const;
};

/// Runs `arguments` (the program first) to its end. Its output goes to the file `log`. Throws Error
/// when it cannot be started or the log not be written.
ProcessResult run_process(const std::vector<std::string>& arguments, const std::string& log,
                          const ProcessLimits& limits = {});

/// The folder that this program lies in.
std::string program_folder();

}  // namespace tessera::trade
