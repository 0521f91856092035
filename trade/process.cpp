#include "trade/process.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <fcntl.h>
#include <fmt/format.h>
#include <malloc.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/error.h"

namespace tessera::trade {
namespace {

constexpr int exec_failed = 127;

/// In the child, between fork and exec: only calls that are safe there.
[[noreturn]] void become(char* const* argv, int log) {
  // A group of its own: Ctrl-C reaches this program alone, which then ends the child itself.
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  const int nothing = open("/dev/null", O_RDONLY);
  dup2(nothing, STDIN_FILENO);
  dup2(log, STDOUT_FILENO);
  dup2(log, STDERR_FILENO);
  execv(argv[0], argv);
  _exit(exec_failed);
}

/// Forks rather than vforks: the kernel counts the peak of the address space that exec leaves
/// behind as the child's, and after a fork that is a copy with what is resident now, not with
/// what images took here before.
pid_t start(const std::vector<std::string>& arguments, int log) {
  std::vector<char*> argv;
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  malloc_trim(0);
  const pid_t id = fork();
  if (id == 0) become(argv.data(), log);
  if (id < 0) throw Error(fmt::format("cannot start {}: {}", arguments[0], std::strerror(errno)));
  return id;
}

/// A descriptor that becomes readable when a process ends.
class EndOfProcess {
 public:
  explicit EndOfProcess(pid_t id) : descriptor_(int(syscall(SYS_pidfd_open, id, 0))) {}
  ~EndOfProcess() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  EndOfProcess(const EndOfProcess&) = delete;
  EndOfProcess& operator=(const EndOfProcess&) = delete;

  /// Sleeps until the end or for a moment. Where the kernel has no such descriptors, a short one.
  void wait() const {
    if (descriptor_ < 0) {
      usleep(1000);
      return;
    }
    pollfd entry{descriptor_, POLLIN, 0};
    poll(&entry, 1, 50);
  }

 private:
  int descriptor_;
};

double seconds(const timeval& time) { return double(time.tv_sec) + 1e-6 * double(time.tv_usec); }

std::string read_all(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

/// Waits for the end, and brings it about when a limit is passed.
void wait_for(pid_t id, const ProcessLimits& limits, ProcessResult& result) {
  const auto begin = std::chrono::steady_clock::now();
  const auto elapsed = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  const EndOfProcess end(id);
  rusage usage{};
  int status = 0;
  bool killed = false;
  for (;;) {
    const pid_t done = wait4(id, &status, WNOHANG, &usage);
    if (done == id) break;
    if (done < 0 && errno != EINTR) throw Error("lost sight of a process that was started");
    if (!killed && ((limits.cancel && *limits.cancel) || elapsed() > limits.timeout_s)) {
      result.cancelled = limits.cancel && *limits.cancel;
      result.timed_out = !result.cancelled;
      killed = kill(id, SIGKILL) == 0;
    }
    end.wait();
  }
  result.wall_s = elapsed();
  result.cpu_s = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  result.peak_bytes = uint64_t(usage.ru_maxrss) * 1024;  // Linux reports KiB
  if (WIFSIGNALED(status)) result.signal = WTERMSIG(status);
  if (WIFEXITED(status)) result.exit_code = WEXITSTATUS(status);
}

}  // namespace

std::string ProcessResult::failure() const {
  if (ok()) return "";
  if (timed_out) return fmt::format("stopped after {:.3g} s: the time limit of a run", wall_s);
  if (cancelled) return "interrupted";
  std::string last;
  std::istringstream lines(output);
  for (std::string line; std::getline(lines, line);) {
    const size_t at = line.find("error: ");
    if (at != line.npos) last = line.substr(at + 7);
  }
  if (signal != 0) return fmt::format("ended by signal {} ({})", signal, strsignal(signal));
  if (!last.empty()) return last;
  return fmt::format("ended with exit code {}", exit_code);
}

ProcessResult run_process(const std::vector<std::string>& arguments, const std::string& log,
                          const ProcessLimits& limits) {
  if (access(arguments[0].c_str(), X_OK) != 0)
    throw Error(fmt::format("cannot run {}: {}", arguments[0], std::strerror(errno)));
  const int descriptor = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor < 0) throw Error(fmt::format("cannot write {}: {}", log, std::strerror(errno)));
  ProcessResult result;
  try {
    wait_for(start(arguments, descriptor), limits, result);
  } catch (...) {
    close(descriptor);
    throw;
  }
  close(descriptor);
  result.output = read_all(log);
  return result;
}

std::string program_folder() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path().string();
}

}  // namespace tessera::trade
