#pragma once
/// Everything that a sweep runs, and what it leaves out.

#include <functional>
#include <string>
#include <vector>

#include "trade/knobs.h"

namespace tessera::trade {

struct SweepRequest {
  std::vector<KnobChoice> knobs;
  std::vector<Baseline> baselines;
  bool qualities = false;   ///< the renderer's presets, besides
  std::vector<int> ladder;  ///< samples per pixel of every turn, rising, at least one
  ScenePlan plan;           ///< of the default
  /// Options that every run is given: a knob among them is held.
  std::vector<std::string> common;
  std::function<bool(const std::string&)> has_option;  ///< of the renderer
};

struct SweepList {
  std::vector<Configuration> configurations;   ///< the default first; ids are not set
  std::vector<Turn> turns;                     ///< of knobs and presets, the default left out
  std::vector<Baseline> baselines;             ///< those that are run
  std::vector<std::string> notes;              ///< what is left out, and why
  std::vector<std::string> missing_baselines;  ///< the same of baselines
  int scene_spp = 16;                          ///< samples per pixel that the scene itself asks for
  /// The same within the ladder: where the default is compared with others.
  int pivot_spp = 16;
};

/// The ladder of the default configuration: `ladder`, a step between each two of it (their
/// geometric mean) and the pivot, so that others can be compared along it.
std::vector<int> default_ladder(const std::vector<int>& ladder, int pivot_spp);

/// Lists configurations, each once. Knobs that the renderer does not have, that are held by the
/// common options or that cannot matter in this scene are left out with a note; so are values equal
/// to the default.
SweepList list_configurations(const SweepRequest& request);

/// What a knob is when nothing turns it.
std::string default_of(const Knob& knob, const ScenePlan& plan);

}  // namespace tessera::trade
