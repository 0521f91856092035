#include "shade/light_terms.h"

namespace tessera {

std::unique_ptr<Shading> make_shading(std::string_view spec, const ShadingFrame& frame) {
  const size_t colon = spec.find(':');
  const std::string_view name = spec.substr(0, colon);
  const std::string_view arguments =
      colon == std::string_view::npos ? std::string_view() : spec.substr(colon + 1);
  std::string choices;
  for (const ShadingModeDefinition& mode : shading_mode_registry()) {
    if (mode.name == name) {
      auto shading = mode.make(arguments, frame);
      const bool own_rates = frame.bindings && frame.bindings->light_term_count() > 0;
      return own_rates ? with_light_terms(std::move(shading), frame.bindings) : std::move(shading);
    }
    choices += fmt::format("{}{}", choices.empty() ? "" : ", ", mode.name);
  }
  throw Error(fmt::format("unknown shading mode \"{}\"; expected one of: {}", name, choices));
}

}  // namespace tessera
