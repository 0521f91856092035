#include "engine/interrupt.h"

#include <cerrno>
#include <cstdint>
#include <system_error>

#include <fmt/format.h>
#include <poll.h>
#include <pthread.h>
#include <sys/eventfd.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include "base/error.h"

namespace tessera {

// Both signals are blocked in every thread and read from a descriptor by one thread of our own: no
// code runs inside a signal handler, and so nothing has to be global. Signals that were ignored
// when the program started (as a shell does for background jobs of a script) are watched as well:
// whoever sends one to a renderer means it.
InterruptWatch::InterruptWatch() {
  sigemptyset(&signals_);
  sigaddset(&signals_, SIGINT);
  sigaddset(&signals_, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals_, &previous_mask_);
  signal_descriptor_ = signalfd(-1, &signals_, SFD_CLOEXEC);
  stop_descriptor_ = eventfd(0, EFD_CLOEXEC);
  if (signal_descriptor_ < 0 || stop_descriptor_ < 0) {
    release();
    throw Error("cannot watch for Ctrl-C: the system gives no descriptor for signals");
  }
  try {
    thread_ = std::thread([this] { watch(); });
  } catch (const std::system_error& error) {
    release();
    throw Error(fmt::format("cannot watch for Ctrl-C: {}", error.what()));
  }
}

InterruptWatch::~InterruptWatch() {
  const uint64_t one = 1;
  // The counter cannot overflow, so the write cannot fail.
  [[maybe_unused]] const ssize_t written = write(stop_descriptor_, &one, sizeof one);
  thread_.join();
  release();
}

void InterruptWatch::release() {
  for (const int descriptor : {signal_descriptor_, stop_descriptor_})
    if (descriptor >= 0) close(descriptor);
  pthread_sigmask(SIG_SETMASK, &previous_mask_, nullptr);
}

void InterruptWatch::watch() {
  pollfd descriptors[] = {{signal_descriptor_, POLLIN, 0}, {stop_descriptor_, POLLIN, 0}};
  while (poll(descriptors, 2, -1) < 0 && errno == EINTR) {
  }
  if (!(descriptors[0].revents & POLLIN)) return;
  signalfd_siginfo info;
  if (read(signal_descriptor_, &info, sizeof info) != sizeof info) return;
  interrupted_ = true;
  // From here on a signal finds this thread willing to take it, with the default action.
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  pthread_sigmask(SIG_UNBLOCK, &signals_, nullptr);
  poll(&descriptors[1], 1, -1);
}

}  // namespace tessera
