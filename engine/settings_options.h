#pragma once
/// Settings as command-line options, shared by every command that takes a scene.

#include <string>

#include "engine/settings.h"

namespace CLI {
class App;
}

namespace tessera {

/// Adds one option for each member of `settings`, which they write to when parsed. Values are
/// checked there: names against the registries, numbers against their range.
void add_settings_options(CLI::App& app, Settings& settings);

/// The hiders, shading modes, filters and AOVs there are, for the end of --help.
std::string list_choices();

}  // namespace tessera
