#include "shade/emitter.h"

namespace tessera {
namespace {

/// Places of an emitter, found once for points in a row that ask for the same.
class RecentPlace {
 public:
  explicit RecentPlace(const Emitter& emitter) : emitter_(emitter) {}

  const LightPlace& at(const glm::vec2& xi, float time) {
    if (xi != xi_ || time != time_) place_ = emitter_.place(xi, time), xi_ = xi, time_ = time;
    return place_;
  }

 private:
  const Emitter& emitter_;
  glm::vec2 xi_{-1.0f};  // none
  float time_ = 0.0f;
  LightPlace place_;
};

void illuminate_from(const BoundLight& light, const ShadingPoints& points,
                     std::span<const glm::vec2> xi, PlaceSamples& out) {
  if (!light.emitter) return;  // nobody has said where its surfaces are
  const glm::vec3 radiance = radiance_of(light.parameters);
  const bool double_sided = light.parameters.scalar("doublesided") != 0.0f;
  const bool timed = points.time && light.emitter->moves();
  RecentPlace recent(*light.emitter);
  for (int i = 0; i < points.count; ++i) {
    const LightPlace& place = recent.at(xi[size_t(i)], timed ? points.time[i] : 0.0f);
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
