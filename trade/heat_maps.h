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

struct HeatMapRequest {
  std::string folder;               ///< where the maps go
  std::function<double()> left_s;   ///< seconds in which the maps have to be there
  std::function<bool()> cancelled;  ///< true: no more of them
};

struct HeatMaps {
  std::vector<std::pair<std::string, std::string>> made;  ///< (id of a run, measure)
  std::vector<std::string> notes;                         ///< what is missing, and why
};

/// Renders each of the runs once more for each measure, untimed, into FOLDER/ID.MEASURE.exr, with
/// a channel heatmap.MEASURE. A map that would take longer than is left, by what its run took, is
/// left out, and one that is not done by then is given up.
HeatMaps render_heat_maps(const Renderer& renderer, const std::vector<const Run*>& runs,
                          const HeatMapRequest& request);

}  // namespace tessera::trade
