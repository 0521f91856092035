#pragma once
/// Stage header: trade. A scene and options go in; a folder with the trade of time against error
/// comes out. Drives the renderer from outside.

#include <atomic>
#include <string>

#include "trade/command_line.h"

namespace tessera::trade {

/// Runs a sweep and writes everything. Returns an exit code of engine/command.h. `program`: the
/// renderer. When `cancel` turns true, the run under way is given up and what was finished is
/// written. Throws Error for what cannot be swept at all.
int run_trade(const TradeOptions& options, const std::string& program,
              const std::atomic<bool>& cancel);

}  // namespace tessera::trade
