/// The program: reads the command line, sweeps, and turns what went wrong into a message and exit
/// code.

#include <cstdio>
#include <exception>

#include <fmt/format.h>

#include "engine/command.h"
#include "engine/interrupt.h"
#include "trade/process.h"
#include "trade/trade.h"

int main(int argc, char** argv) {
  using namespace tessera;
  int exit_code = exit_success;
  const auto options = trade::parse_command_line(argc, argv, exit_code);
  if (!options) return exit_code;
  try {
    // Before anything that starts threads.
    const InterruptWatch interrupt;
    return trade::run_trade(*options, trade::program_folder() + "/tessera",
                            interrupt.interrupted());
  } catch (const std::exception& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return exit_failure;
  }
}
