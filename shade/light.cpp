#include "shade/light.h"

#include "shade/shade.h"

namespace tessera {

const LightDefinition* find_light(std::string_view name) {
  for (const LightDefinition& definition : light_registry()) {
    if (definition.name == name) return &definition;
  }
  return nullptr;
}

void illuminate_from(const BoundLight& light, const ShadingPoints& points,
                     std::span<const glm::vec2> xi, ShadeCounters* counters, PlaceSamples& out) {
  out.reset(points.count);
  light.definition->illuminate_from(light, points, xi, out);
  if (counters) counters->texture_lookups += out.texture_lookups;
}

}  // namespace tessera
