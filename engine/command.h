#pragma once
/// What the command line is made of. Every engine/commands/STEM.cpp defines
/// `CommandDefinition command_STEM();` and is then a subcommand of the program.

#include <functional>
#include <span>
#include <string>

#include "base/error.h"

namespace CLI {
class App;
}

namespace tessera {

/// The exit codes of the program.
enum ExitCode : int {
  exit_success = 0,
  exit_failure = 1,     ///< something failed, or images differ past the limit
  exit_usage = 2,       ///< the command line was not understood
  exit_cancelled = 130  ///< stopped by Ctrl-C, as shells report it
};

/// The command line asks for something that makes no sense, found after it was parsed.
class UsageError : public Error {
 public:
  using Error::Error;
};

struct CommandDefinition {
  std::string name;
  std::string help;  ///< one line
  /// Adds the options of the command to `app` and returns what runs it once they are parsed. That
  /// returns an exit code; it may throw Error. `app` outlives what is returned.
  std::function<std::function<int()>(CLI::App& app)> set_up;
};

/// Every command, by name. Generated from the files of engine/commands/.
std::span<const CommandDefinition> command_registry();

}  // namespace tessera
