#pragma once
/// What can be turned: one row for each knob, one for each baseline.

#include <span>
#include <string>
#include <vector>

#include "trade/configuration.h"
#include "trade/scene_plan.h"

namespace tessera::trade {

struct Knob {
  std::string name;    ///< as --knobs takes it
  std::string option;  ///< of `tessera render`
  std::string what;    ///< a few words
  /// What a value is given to the option as: "{}" stands for the value.
  std::string argument = "{}";
  std::string default_value = {};        ///< in words, where the plan does not say it
  std::string plan_entry = {};           ///< entry of the plan that holds the default; empty: none
  std::vector<std::string> values = {};  ///< swept unless --knobs says otherwise
  bool numeric = false;                  ///< values are numbers
  /// Why turning it cannot change anything in this scene; empty: it can.
  std::string (*idle)(const ScenePlan& plan) = nullptr;
};

/// A method of others that the default is compared with: a knob turned to it.
struct Baseline {
  std::string name;  ///< as --against takes it
  Turn turn;
  std::string what;  ///< a few words
};

/// Every knob, samples per pixel first.
std::span<const Knob> knob_table();
std::span<const Baseline> baseline_table();

/// Throws Error listing what there is.
const Knob& find_knob(const std::string& name);
const Baseline& find_baseline(const std::string& name);

/// The options of `tessera render` that turn a knob.
std::vector<std::string> options_of(const Turn& turn);

/// A knob and the values to sweep it over.
struct KnobChoice {
  const Knob* knob = nullptr;
  std::vector<std::string> values;
};

/// Reads "spp,hider=shear:dual,...": knobs separated by commas, values by colons. In a value that
/// is a name, what follows a colon and begins with a digit or holds a '=' is an argument of it, as
/// in "reconstruct=maaf:9:fsf". Empty: every knob with the values of its row. Throws Error for
/// unknown or repeated knobs, and for values that are not numbers where numbers are expected.
std::vector<KnobChoice> parse_knobs(const std::string& text);

/// Reads "ds,aaf,...". Throws Error for unknown names.
std::vector<Baseline> parse_baselines(const std::string& text);

/// Reads "4,16,64": rising sample counts without repeats. Throws Error unless each is a whole
/// number from 1 to 65536.
std::vector<int> parse_ladder(const std::string& text);

}  // namespace tessera::trade
