#include "shade/emitter.h"

namespace tessera {
namespace {

void illuminate_from(const BoundLight& light, const ShadingPoints& points,
                     std::span<const glm::vec2> xi, PlaceSamples& out) {
  if (!light.emitter) return;  // nobody traces rays: where its surfaces are is not known
  const glm::vec3 radiance = radiance_of(light.parameters);
  const bool double_sided = light.parameters.scalar("doublesided") != 0.0f;
  for (int i = 0; i < points.count; ++i) {
    const float time = points.time ? points.time[i] : 0.0f;
    const LightPlace place = light.emitter->place(xi[size_t(i)], time);
    set_place(light, points.P[i], place, radiance, double_sided, i, out);
  }
}

}  // namespace

LightDefinition light_arealight() {
  return {.name = "arealight",
          .help = "surfaces that shine along their outward normals",
          .parameters = with_extent_parameters(
              {scalar_parameter("doublesided", 0.0f, "other than 0: shines from both sides")}),
          .illuminate_from = illuminate_from,
          .share_from = share_from_extent};
}

}  // namespace tessera
