#pragma once
/// The default against methods of others, as a paper prints it.

#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "trade/knobs.h"
#include "trade/measurement.h"

namespace tessera::trade {

/// A table of trade.json: title, columns, rows and notes. One row for each baseline: its time and
/// error at `wanted_spp`, or the samples of the default's run that is nearest to it; the time to
/// reach the default's error there over the default's time, and the error after the default's time
/// over the default's error; both over the ladder, as geometric means. Above 1: the default is
/// better. `missing` are baselines that were not run, with why.
nlohmann::ordered_json against_table(const std::vector<Run>& runs,
                                     const std::vector<Baseline>& baselines, int wanted_spp,
                                     const std::vector<std::string>& missing);

}  // namespace tessera::trade
