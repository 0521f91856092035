#pragma once
/// The arguments of a shading mode: `--shading name:key=value,key=value`.

#include <initializer_list>
#include <string_view>

namespace tessera {

/// A number that a mode may be given, and the interval (above, at_most] that it must lie in.
struct ModeArgument {
  const char* key;
  const char* what;  ///< for messages: "share of the lens's energy"
  double* value;
  double above, at_most;
};

/// Sets what `arguments` give. Throws Error for anything else: an unknown key, one given twice, no
/// number, a number out of its interval; `mode` names the mode in messages.
void read_mode_arguments(const char* mode, std::string_view arguments,
                         std::initializer_list<ModeArgument> known);

}  // namespace tessera
