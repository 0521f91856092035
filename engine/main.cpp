/// The program: picks a command, runs it, and turns what went wrong into a message and exit code.

#include <cstdio>
#include <exception>
#include <new>
#include <vector>

#include <CLI/CLI.hpp>
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "engine/command.h"
#include "engine/version.h"

namespace {

using namespace tessera;

std::string failure_message(const CLI::App* app, const CLI::Error& error) {
  std::string message = error.what();
  // What stands in the place of a command is left over when it is none.
  if (app->get_subcommands().empty() && !app->remaining().empty()) {
    message = fmt::format("no command or option '{}'", app->remaining().front());
  }
  return fmt::format("error: {}\nRun with --help for the options.\n", message);
}

int report(ExitCode code, std::string_view message) {
  std::fputs(fmt::format("error: {}\n", message).c_str(), stderr);  // throws nothing if it fails
  return code;
}

/// Standard streams that are closed would give their descriptors to the first files that are
/// opened, and what is printed would end up in these. Opened the wrong way round, they still fail.
void reserve_standard_descriptors() {
  for (int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(descriptor, F_GETFD) < 0)
      // The lowest that is free is the one that is closed.
      (void)open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

/// Results that were asked for and got lost are a failure.
int after_writing(int code) {
  if ((std::fflush(stdout) == 0 && !std::ferror(stdout)) || code != exit_success) return code;
  return report(exit_failure,
                "standard output is full or closed; what was printed is not complete");
}

/// Runs a parsed command.
int run_command(const std::function<int()>& run) {
  try {
    return run();
  } catch (const UsageError& error) {
    return report(exit_usage, error.what());
  } catch (const std::bad_alloc&) {
    return report(exit_failure, "out of memory");
  } catch (const std::exception& error) {
    return report(exit_failure, error.what());
  }
}

}  // namespace

int main(int argc, char** argv) {
  reserve_standard_descriptors();
  CLI::App app("Tessera renders film-style frames from scene files.", "tessera");
  app.require_subcommand(1);
  app.failure_message(failure_message);
  app.set_version_flag("--version", fmt::format("Tessera {}", version));

  std::function<int()> run;
  for (const CommandDefinition& command : command_registry()) {
    CLI::App* sub = app.add_subcommand(command.name, command.help);
    // Options are added to the one command that was called: its set-up may be costly.
    sub->preparse_callback([&run, &command, sub](size_t) { run = command.set_up(*sub); });
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return after_writing(app.exit(error) == 0 ? exit_success : exit_usage);
  }
  return after_writing(run_command(run));
}
