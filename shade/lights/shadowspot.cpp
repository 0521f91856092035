#include "shade/light.h"

namespace tessera {

LightDefinition light_spotlight();

/// A spot light with a shadow map, as many scenes name it. The map is not read yet.
LightDefinition light_shadowspot() {
  LightDefinition light = light_spotlight();
  light.name = "shadowspot";
  light.help = "spotlight with a shadow map (the map is ignored)";
  light.parameters.push_back(string_parameter("shadowname", "", "shadow map, ignored"));
  light.parameters.push_back(scalar_parameter("samples", 16.0f, "of the shadow map, ignored"));
  light.parameters.push_back(scalar_parameter("width", 1.0f, "of the shadow filter, ignored"));
  light.parameters.push_back(scalar_parameter("blur", 0.0f, "of the shadow filter, ignored"));
  light.parameters.push_back(scalar_parameter("bias", 0.0f, "of the shadow map, ignored"));
  light.limitation = "its shadow map is ignored: it casts no shadows";
  return light;
}

}  // namespace tessera
