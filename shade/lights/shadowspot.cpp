#include "shade/light.h"

namespace tessera {

LightDefinition light_spotlight();

/// The name by which many scenes call a spot light with a shadow map.
LightDefinition light_shadowspot() {
  LightDefinition light = light_spotlight();
  light.name = "shadowspot";
  light.help = "spotlight, by another name";
  return light;
}

}  // namespace tessera
