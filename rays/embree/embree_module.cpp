// The module that answers rays with Embree (rays/ray_module.h).

#include <algorithm>
#include <cmath>
#include <limits>

#include "rays/embree/embree_scene.h"
#include "shade/mathematics.h"

namespace tessera {

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
/// Rounding of an origin that was interpolated on its surface, relative to its coordinates: nothing
/// nearer is met, and it lies on every plane of its surface within twice as much.
constexpr float origin_noise = 1e-6f;

/// A ray in Embree's form, with a direction of unit length.
struct PreparedRay {
  RTCRayHit embree;
  RayQuery query;
  double length = 0;  ///< of the given direction, in Embree's units; 0: the ray meets nothing

  PreparedRay(const Rays& rays, size_t i, float scale, RTCFilterFunctionN filter);
  float distance_of(float t) const { return float(double(t) / length); }
};

/// The largest t whose distance is less than `far`.
float last_t_before(float far, double length) {
  if (far == infinity) return infinity;
  const double t = double(far) * length;
  float last =
      t < double(std::numeric_limits<float>::max()) ? float(t) : std::numeric_limits<float>::max();
  // Rounded once, and once again on the way back.
  for (int k = 0; k < 4 && !(float(double(last) / length) < far); ++k) {
    last = std::nextafter(last, 0.0f);
  }
  return last;
}

PreparedRay::PreparedRay(const Rays& rays, size_t i, float scale, RTCFilterFunctionN filter) {
  const glm::vec3 o = scale * rays.origin[int(i)], d = rays.direction[int(i)];
  const bool valid = is_finite(o) && is_finite(d) && rays.far[i] > 0 && !std::isnan(rays.time[i]);
  if (!valid) return;
  const double given = glm::length(glm::dvec3(d));
  length = given * double(scale);
  if (length == 0) return;
  const float noise = origin_noise * std::max({std::abs(o.x), std::abs(o.y), std::abs(o.z)});
  RTCRay& ray = embree.ray;
  ray.org_x = o.x, ray.org_y = o.y, ray.org_z = o.z;
  ray.dir_x = float(d.x / given), ray.dir_y = float(d.y / given), ray.dir_z = float(d.z / given);
  ray.tnear = noise;
  ray.tfar = last_t_before(rays.far[i], length);
  ray.time = std::clamp(rays.time[i], 0.0f, 1.0f);
  ray.mask = ~0u;
  ray.id = ray.flags = 0;
  embree.hit.geomID = embree.hit.primID = RTC_INVALID_GEOMETRY_ID;
  embree.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcInitIntersectContext(&query.context);
  query.context.filter = filter;
  query.surface = rays.surface[i];
  query.height_noise = 2 * noise;
}

class EmbreeTracer final : public RayTracer {
 public:
  explicit EmbreeTracer(RayScene&& scene) : scene_(std::move(scene)) {}

  void closest(const Rays& rays, RayHits& hits) const override {
    const size_t count = size_t(rays.count());
    hits.distance.assign(count, infinity);
    hits.grid.assign(count, 0), hits.triangle.assign(count, 0);
    hits.b1.assign(count, 0.0f), hits.b2.assign(count, 0.0f);
    for (size_t i = 0; i < count; ++i) {
      PreparedRay ray(rays, i, scene_.scale(), &keep_nearest);
      if (!trace(ray)) continue;
      const RTCHit& hit = ray.embree.hit;
      const MetGeometry& met = scene_.geometry(hit.geomID);
      const uint32_t grid = met.micropolygons[hit.primID / 2].grid;
      hits.distance[i] = ray.distance_of(ray.embree.ray.tfar);
      hits.grid[i] = grid;
      hits.triangle[i] = hit.primID - 2 * met.grids[grid].first_micropolygon;
      hits.b1[i] = hit.u, hits.b2[i] = hit.v;
    }
  }

  void shadow(const Rays& rays, RayShadows& shadows) const override {
    const size_t count = size_t(rays.count());
    shadows.share.assign(count, 1.0f);
    shadows.distance.assign(count, infinity);
    const RTCFilterFunctionN filter = scene_.is_opaque() ? &keep_nearest : &keep_nearest_opaque;
    for (size_t i = 0; i < count; ++i) {
      PreparedRay ray(rays, i, scene_.scale(), filter);
      const bool blocked = trace(ray);
      float nearest = ray.query.nearest_layer_t;
      if (blocked) nearest = std::min(nearest, ray.embree.ray.tfar);
      if (nearest == infinity) continue;
      shadows.share[i] =
          blocked ? 0.0f : float(std::exp2(double(ray.query.log2_passing) * 0x1p-32));
      shadows.distance[i] = ray.distance_of(nearest);
    }
  }

  std::span<const std::shared_ptr<const Grid>> grids() const override { return scene_.grids(); }
  size_t memory_bytes() const override { return scene_.memory_bytes(); }

 private:
  /// Whether a hit was kept.
  bool trace(PreparedRay& ray) const {
    if (ray.length == 0) return false;
    rtcIntersect1(scene_.embree(), &ray.query.context, &ray.embree);
    return ray.embree.hit.geomID != RTC_INVALID_GEOMETRY_ID;
  }

  EmbreeScene scene_;
};

}  // namespace

}  // namespace tessera

extern "C" tessera::RayTracer* tessera_ray_module_1(tessera::RayScene&& scene) {
  return new tessera::EmbreeTracer(std::move(scene));
}
