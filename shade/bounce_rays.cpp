#include "shade/bounce_rays.h"

#include <cmath>

#include "shade/bounce_radiance.h"
#include "shade/shade.h"

namespace tessera {
namespace {

constexpr int most_layers = 16;

/// Rays on their way.
struct Travellers {
  Rays rays;
  std::vector<int> source;         ///< among the rays that were asked for
  std::vector<glm::vec3> through;  ///< share of light that passes what has been met
};

Travellers all_of(const Rays& rays) {
  Travellers all{rays, {}, {}};
  for (int i = 0; i < rays.count(); ++i) {
    all.source.push_back(i);
    all.through.emplace_back(1.0f);
  }
  return all;
}

/// Those that go on behind what they met.
Travellers behind(const Travellers& from, const RayHits& hits, const RayTracer& tracer) {
  std::vector<int> going_on;
  std::vector<glm::vec3> passing;
  for (int i = 0; i < from.rays.count(); ++i) {
    const size_t k = size_t(i);
    if (!std::isfinite(hits.distance[k])) continue;
    const Attributes& attributes = tracer.grids()[hits.grid[k]]->attributes();
    const glm::vec3 clear = glm::clamp(1.0f - attributes.opacity, 0.0f, 1.0f);
    const glm::vec3 through = from.through[k] * clear;
    if (through == glm::vec3(0.0f)) continue;
    going_on.push_back(i), passing.push_back(through);
  }
  Travellers result{Rays(int(going_on.size())), {}, std::move(passing)};
  for (size_t n = 0; n < going_on.size(); ++n) {
    const int i = going_on[n];
    const size_t k = size_t(i);
    const glm::vec3 direction = from.rays.direction[i];
    result.rays.origin.set(int(n), from.rays.origin[i] + hits.distance[k] * direction);
    result.rays.direction.set(int(n), direction);
    result.rays.far[n] = from.rays.far[k] - hits.distance[k];
    result.rays.time[n] = from.rays.time[k];
    result.rays.surface[n] = int32_t(tracer.grids()[hits.grid[k]]->surface->id);
    result.source.push_back(from.source[k]);
  }
  return result;
}

}  // namespace

void follow_rays(const Rays& rays, const LightServices& services, BounceArrivals& out) {
  out.radiance.reset(rays.count());
  out.distance.assign(size_t(rays.count()), std::numeric_limits<float>::infinity());
  if (!services.rays || !services.bounce) return;
  RayHits hits;
  Vec3Array met;
  Travellers on_way = all_of(rays);
  for (int layer = 0; layer < most_layers && on_way.rays.count() > 0; ++layer) {
    services.rays->closest(on_way.rays, hits);
    services.counters->rays += uint64_t(on_way.rays.count());
    services.bounce->radiance(on_way.rays, hits, met, *services.counters);
    for (int i = 0; i < on_way.rays.count(); ++i)
      out.radiance.add(on_way.source[size_t(i)], on_way.through[size_t(i)] * met[i]);
    if (layer == 0) out.distance = hits.distance;
    on_way = behind(on_way, hits, *services.rays);
  }
}

}  // namespace tessera
