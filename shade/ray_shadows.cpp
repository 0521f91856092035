#include "shade/ray_shadows.h"

#include <limits>

#include "shade/ray_tracer.h"

namespace tessera {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
/// Of the way to the light. Rounding moves the light's own surface by far less.
constexpr float short_of_light = 1.0f - 1e-4f;

}  // namespace

void trace_shadows(const RayTracer* tracer, const ShadingPoints& points, const Vec3Array& towards,
                   bool infinite, PlaceShadows& out) {
  out.share.assign(size_t(points.count), 1.0f);
  out.distance.assign(size_t(points.count), infinity);
  out.rays = 0;
  if (!tracer) return;
  std::vector<int> casting;
  for (int i = 0; i < points.count; ++i) {
    if (towards[i] != glm::vec3(0.0f)) casting.push_back(i);
  }
  Rays rays(int(casting.size()));
  for (int k = 0; k < rays.count(); ++k) {
    const int i = casting[size_t(k)];
    rays.origin.set(k, points.P[i]);
    rays.direction.set(k, towards[i]);
    rays.far[size_t(k)] = infinite ? infinity : short_of_light;
    rays.time[size_t(k)] = points.time ? points.time[i] : 0.0f;
    rays.surface[size_t(k)] = points.surface ? points.surface[i] : -1;
  }
  RayShadows shadows;
  tracer->shadow(rays, shadows);
  for (size_t k = 0; k < casting.size(); ++k) {
    out.share[size_t(casting[k])] = shadows.share[k];
    out.distance[size_t(casting[k])] = shadows.distance[k];
  }
  out.rays = casting.size();
}

}  // namespace tessera
