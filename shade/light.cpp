#include "shade/light.h"

namespace tessera {

const LightDefinition* find_light(std::string_view name) {
  for (const LightDefinition& definition : light_registry()) {
    if (definition.name == name) return &definition;
  }
  return nullptr;
}

}  // namespace tessera
