#pragma once
/// From measurements to what is written.

#include "trade/command_line.h"
#include "trade/schedule.h"
#include "trade/table.h"

namespace tessera::trade {

/// Fills in the table's runs, front, words, tables and what the sweep did not come to.
void conclude(const TradeOptions& options, const SweepOutcome& outcome, TradeTable& table);

/// Makes the folder of the page that --report asks for, before hours are spent on it. Throws Error
/// when the page could not be written.
void prepare_report(const TradeOptions& options);

/// Writes trade.json and trade.csv, prints the table, and writes the page that --report asks for.
/// Throws Error when a file cannot be written.
void write_results(const TradeOptions& options, const TradeTable& table);

}  // namespace tessera::trade
