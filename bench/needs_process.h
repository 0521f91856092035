#pragma once
/// Work in a process of its own, with what it found and the memory it took.

#include <array>
#include <cstdio>
#include <exception>
#include <functional>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/error.h"

namespace tessera {

struct IsolatedResult {
  std::array<double, 2> values{};  ///< what the work returned
  double peak_bytes = 0;           ///< resident memory high-water mark, with what the parent held
};

/// Runs `work` in a copy of this process, which must not have started threads. Throws Error when it
/// fails.
inline IsolatedResult run_isolated(const std::function<std::array<double, 2>()>& work) {
  int ends[2];
  if (pipe(ends) != 0) throw Error("cannot make a pipe");
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child < 0) throw Error("cannot start a process");
  if (child == 0) {
    int status = 1;
    try {
      const std::array<double, 2> values = work();
      status = write(ends[1], values.data(), sizeof values) == ssize_t(sizeof values) ? 0 : 1;
    } catch (const std::exception& error) {
      std::fprintf(stderr, "%s\n", error.what());
    }
    _exit(status);
  }
  close(ends[1]);
  IsolatedResult result;
  const ssize_t got = read(ends[0], result.values.data(), sizeof result.values);
  close(ends[0]);
  int status = 0;
  rusage usage{};
  wait4(child, &status, 0, &usage);
  if (status != 0 || got != ssize_t(sizeof result.values))
    throw Error("a frame that is measured failed");
  result.peak_bytes = 1024.0 * double(usage.ru_maxrss);
  return result;
}

}  // namespace tessera
