#pragma once
/// Tables of benchmarks, to stand beside a sweep on its page: extremes with their verdicts, what
/// features cost.

#include <string>

#include <nlohmann/json.hpp>

namespace tessera::trade {

/// What `./tessera bench NAME --json FILE` wrote, as a table of trade.json: a column for every
/// name that some row has, in order of appearance; null where a row has no such column. Throws
/// Error naming the file when it cannot be read or is no such thing.
nlohmann::ordered_json read_bench_table(const std::string& file);

}  // namespace tessera::trade
