#pragma once
/// What the renderer says of the scene: the plan in the statistics of a first run.

#include <map>
#include <string>

namespace tessera::trade {

struct ScenePlan {
  std::map<std::string, std::string> entries;  ///< as `tessera info` prints them
  std::map<std::string, std::string> options;  ///< in force: format, crop, shutter, ...

  /// Whether a feature is in the scene.
  bool has(const std::string& feature) const { return text(feature) == "yes"; }
  /// The value of an entry; empty when there is none.
  std::string text(const std::string& name) const {
    const auto entry = entries.find(name);
    return entry == entries.end() ? std::string() : entry->second;
  }
};

}  // namespace tessera::trade
