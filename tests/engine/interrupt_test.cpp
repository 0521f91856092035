#include <csignal>

#include <catch2/catch.hpp>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/error.h"
#include "engine/interrupt.h"

using namespace tessera;

namespace {

// Runs `work` in a process of its own, as signals act on the whole of it. Returns its wait status.
template <class Work>
int status_of_child(Work work) {
  const pid_t child = fork();
  if (child == 0) {
    alarm(60);  // a hanging child fails the test instead of holding it up
    work();
    _exit(7);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return status;
}

void interrupt_once(const InterruptWatch& watch) {
  kill(getpid(), SIGINT);
  while (!watch.interrupted()) usleep(1000);
}

}  // namespace

TEST_CASE("the first Ctrl-C sets the flag and nothing else") {
  const int status = status_of_child([] {
    const InterruptWatch watch;
    if (watch.interrupted()) _exit(1);
    interrupt_once(watch);
  });
  REQUIRE(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 7);
}

TEST_CASE("the second Ctrl-C ends the program") {
  const int status = status_of_child([] {
    const InterruptWatch watch;
    interrupt_once(watch);
    kill(getpid(), SIGINT);
    for (;;) pause();
  });
  REQUIRE(WIFSIGNALED(status));
  CHECK(WTERMSIG(status) == SIGINT);
}

TEST_CASE("Ctrl-C is seen although it was ignored at the start, as in a script's background") {
  const int status = status_of_child([] {
    std::signal(SIGINT, SIG_IGN);
    const InterruptWatch watch;
    interrupt_once(watch);
  });
  REQUIRE(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 7);
}

TEST_CASE("a watch that saw nothing leaves Ctrl-C as it was") {
  const int status = status_of_child([] {
    std::signal(SIGINT, SIG_DFL);  // the test program has a handler of its own
    { const InterruptWatch watch; }
    kill(getpid(), SIGINT);
    for (;;) pause();
  });
  REQUIRE(WIFSIGNALED(status));
  CHECK(WTERMSIG(status) == SIGINT);
}

TEST_CASE("a watch that cannot be set up leaves signals and descriptors as they were") {
  const int status = status_of_child([] {
    std::signal(SIGINT, SIG_DFL);
    // One descriptor is free: the second that a watch needs is refused.
    const int first = open("/dev/null", O_RDONLY);
    close(first);
    rlimit all{};
    if (getrlimit(RLIMIT_NOFILE, &all) != 0) _exit(1);
    const rlimit one{rlim_t(first) + 1, all.rlim_max};
    if (setrlimit(RLIMIT_NOFILE, &one) != 0) _exit(1);
    try {
      const InterruptWatch watch;
      _exit(2);
    } catch (const Error&) {
      // The undefined-behaviour sanitizer wants descriptors to look at the exception.
      if (setrlimit(RLIMIT_NOFILE, &all) != 0) _exit(1);
    }
    if (open("/dev/null", O_RDONLY) != first) _exit(3);
    kill(getpid(), SIGINT);
    _exit(4);
  });
  REQUIRE(WIFSIGNALED(status));
  CHECK(WTERMSIG(status) == SIGINT);
}
