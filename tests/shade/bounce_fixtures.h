#pragma once
/// Scenes whose surfaces send light on, and lights that come from all around, for the tests of
/// bounces and occlusion.

#include <optional>

#include "shade/bounce_radiance.h"
#include "tests/shade/ray_fixtures.h"

namespace tessera::test {

/// A scene whose rays meet grids made by hand.
struct BounceScene : TestScene {
  std::shared_ptr<const ShaderBindings> bindings;
  std::optional<BruteTracer> tracer;
  std::optional<BounceRadiance> bounce;
  ShadeCounters counters;

  /// Once all lights and surfaces are there. `own` as BruteTracer's.
  void trace(std::vector<std::shared_ptr<const Grid>> grids, double own = 1e-4) {
    bindings = bind();
    tracer.emplace(std::move(grids), own);
    bounce.emplace(*bindings, *tracer);
  }
  LightServices services() { return {&bindings->camera(), &*tracer, &*bounce, &counters}; }
  /// What `rays` bring back from what they meet.
  Vec3Array radiance(const Rays& rays, const RayHits& hits) {
    Vec3Array met;
    bounce->radiance(rays, hits, met, counters);
    return met;
  }
  Vec3Array radiance(const Rays& rays) {
    RayHits hits;
    tracer->closest(rays, hits);
    return radiance(rays, hits);
  }
};

/// Parameters of a light on its own, in camera space.
inline BoundLight bound(const char* name, std::vector<Parameter> parameters,
                        Diagnostics& diagnostics) {
  const LightDefinition* definition = find_light(name);
  REQUIRE(definition);
  return {.definition = definition,
          .parameters = BoundParameters(definition->parameters, call(name, std::move(parameters)),
                                        {}, name, diagnostics),
          .ray_traced = true};
}

inline ShareSamples shares_at(const BoundLight& light, const LightPoints& at,
                              const std::vector<glm::vec2>& xi, const LightServices& services) {
  ShareSamples out;
  light.definition->share_from(light, at.points, xi, services, out);
  return out;
}

/// The cosine-weighted share of directions over a point that an upright rectangle covers: it stands
/// on the point's plane at `distance`, from the foot of the perpendicular `width` to one side, and
/// is `height` high. J. Howell, "A catalog of radiation heat transfer configuration factors", B-4.
inline double upright_rectangle(double distance, double width, double height) {
  const double r = std::hypot(distance, height);
  return (std::atan(width / distance) - distance / r * std::atan(width / r)) / (2.0 * M_PI);
}

}  // namespace tessera::test
