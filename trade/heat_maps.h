#pragma once
/// Maps of what pixels cost, of the runs that a report shows closely.

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "trade/measurement.h"
#include "trade/renderer.h"

namespace tessera::trade {

/// The runs to map: those on the front and the default with the middle one of its sample counts.
std::vector<const Run*> runs_to_map(const std::vector<Run>& runs);

/// Renders each of the runs once more for each measure, untimed, into FOLDER/ID.MEASURE.exr, with
/// a channel heatmap.MEASURE. Returns (id, measure) of those that went well; measures that a run
/// cannot be mapped by are left out.
std::vector<std::pair<std::string, std::string>> render_heat_maps(
    const Renderer& renderer, const std::vector<const Run*>& runs, const std::string& folder,
    const std::function<bool()>& cancelled);

}  // namespace tessera::trade
