#pragma once
/// Ctrl-C: the first asks the work to stop tidily, the second ends the program.

#include <atomic>
#include <csignal>
#include <thread>

namespace tessera {

/// While it lives, the first SIGINT or SIGTERM sets a flag instead of ending the program; after
/// that both have their usual effect again. Must be made before any thread that should not be
/// interrupted, as these inherit its signal mask. At most one at a time.
class InterruptWatch {
 public:
  /// Throws Error when the system refuses.
  InterruptWatch();
  ~InterruptWatch();
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;

  const std::atomic<bool>& interrupted() const { return interrupted_; }

 private:
  void watch();
  void release();  // the descriptors, and the signals as they were

  std::atomic<bool> interrupted_{false};
  sigset_t signals_, previous_mask_;
  int signal_descriptor_ = -1, stop_descriptor_ = -1;
  std::thread thread_;
};

}  // namespace tessera
