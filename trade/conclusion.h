#pragma once
/// From measurements to what is written.

#include "trade/command_line.h"
#include "trade/schedule.h"
#include "trade/table.h"

namespace tessera::trade {

/// Fills in the table's runs, front, words, tables and what the sweep did not come to.
void conclude(const TradeOptions& options, const SweepOutcome& outcome, TradeTable& table);

/// Writes trade.json and trade.csv, prints the table, and writes the page that --report asks for.
/// Throws Error when a file cannot be written.
void write_results(const TradeOptions& options, const TradeTable& table);

}  // namespace tessera::trade
