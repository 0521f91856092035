#include "shade/shade.h"

namespace tessera {

std::unique_ptr<Shading> make_shading(std::string_view spec, const ShadingFrame& frame) {
  const size_t colon = spec.find(':');
  const std::string_view name = spec.substr(0, colon);
  const std::string_view arguments =
      colon == std::string_view::npos ? std::string_view() : spec.substr(colon + 1);
  std::string choices;
  for (const ShadingModeDefinition& mode : shading_mode_registry()) {
    if (mode.name == name) return mode.make(arguments, frame);
    choices += fmt::format("{}{}", choices.empty() ? "" : ", ", mode.name);
  }
  throw Error(fmt::format("unknown shading mode \"{}\"; expected one of: {}", name, choices));
}

}  // namespace tessera
