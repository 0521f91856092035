#pragma once
/// One way of rendering the scene: the options that differ from the renderer's own choice.

#include <string>
#include <utility>
#include <vector>

namespace tessera::trade {

/// A knob and the value it is turned to. The empty knob is the default: nothing is turned.
struct Turn {
  std::string knob, value;

  bool is_default() const { return knob.empty(); }
  /// "hider=bbox", or "default".
  std::string name() const { return is_default() ? "default" : knob + "=" + value; }
  bool operator==(const Turn&) const = default;
};

struct Configuration {
  std::string id;  ///< names its files: "0007"
  Turn turn;
  int spp = 0;                       ///< samples per pixel; 0: the turn itself says how many
  std::vector<std::string> options;  ///< of `tessera render`, besides those of every run

  /// "hider=bbox spp=16". Tells configurations apart.
  std::string label() const {
    if (spp == 0) return turn.name();
    const std::string samples = "spp=" + std::to_string(spp);
    return turn.is_default() ? samples : turn.name() + " " + samples;
  }
  /// (knob, value) of everything that was set.
  std::vector<std::pair<std::string, std::string>> settings() const {
    std::vector<std::pair<std::string, std::string>> list;
    if (spp > 0) list.emplace_back("spp", std::to_string(spp));
    if (!turn.is_default()) list.emplace_back(turn.knob, turn.value);
    return list;
  }
};

}  // namespace tessera::trade
