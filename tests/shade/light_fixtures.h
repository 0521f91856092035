#pragma once
/// Lights bound in scenes of their own, points by hand, and analytic blockers in place of a ray
/// tracer, for the tests of lights with extent.

#include <cmath>
#include <functional>
#include <limits>

#include "shade/extended_light.h"
#include "tests/shade/fixtures.h"

namespace tessera::test {

/// A tracer whose blockers are functions of the segment: the distance along the ray, infinite if it
/// is not met.
class AnalyticBlocker : public RayTracer {
 public:
  using Meet = std::function<double(const glm::dvec3& origin, const glm::dvec3& direction)>;
  explicit AnalyticBlocker(Meet meet, float passes = 0.0f)
      : meet_(std::move(meet)), passes_(passes) {}

  void closest(const Rays&, RayHits&) const override { FAIL("lights ask for shadows only"); }
  void shadow(const Rays& rays, RayShadows& shadows) const override {
    traced += rays.count();
    surfaces.assign(rays.surface.begin(), rays.surface.end());
    shadows.share.assign(size_t(rays.count()), 1.0f);
    shadows.distance.assign(size_t(rays.count()), std::numeric_limits<float>::infinity());
    for (int i = 0; i < rays.count(); ++i) {
      const double t = meet_(glm::dvec3(rays.origin[i]), glm::dvec3(rays.direction[i]));
      if (!(t >= 0.0 && t < rays.far[size_t(i)])) continue;
      shadows.share[size_t(i)] = passes_;
      shadows.distance[size_t(i)] = float(t);
    }
  }
  std::span<const std::shared_ptr<const Grid>> grids() const override { return seen_grids; }
  size_t memory_bytes() const override { return 0; }

  std::vector<std::shared_ptr<const Grid>> seen_grids;
  mutable int64_t traced = 0;
  mutable std::vector<int32_t> surfaces;  ///< of the last batch

 private:
  Meet meet_;
  float passes_;
};

/// Meets the part of the plane z = depth where `covers` says so.
inline AnalyticBlocker::Meet plane_blocker(double depth,
                                           std::function<bool(double x, double y)> covers) {
  return [=](const glm::dvec3& o, const glm::dvec3& d) {
    const double t = (depth - o.z) / d.z;
    const glm::dvec3 at = o + t * d;
    return covers(at.x, at.y) ? t : std::numeric_limits<double>::infinity();
  };
}

/// One light in a scene of its own, with a matte surface that it lights.
struct LitScene {
  TestScene test;
  std::shared_ptr<ShaderBindings> bindings;
  mutable ShadeCounters counters;

  explicit LitScene(ShaderCall light_call, const std::string& shadow = "") {
    test.add_light(std::move(light_call));
    test.scene.lights.back().shadow = shadow;
    test.add_surface("matte");
    test.camera = std::make_unique<Camera>(test.scene.camera);
    bindings = bind_shaders({&test.scene, test.camera.get(), &test.diagnostics, nullptr});
  }
  const BoundLight& light() const {
    return *bindings->of(*test.scene.surfaces.front().attributes).lights.at(0);
  }
  LightServices services() const {
    LightServices services = bindings->light_services();
    services.counters = &counters;
    return services;
  }
};

/// The mean over places of the light of Cl max(0, N . L) at P, unblocked.
inline glm::dvec3 quadrature(const BoundLight& light, const std::vector<glm::vec2>& places,
                             const glm::vec3& P, const glm::vec3& N) {
  const BarePoints at({P}, N);
  glm::dvec3 sum(0.0);
  for (const glm::vec2& place : places) {
    PlaceSamples from;
    from.reset(1);
    light.definition->illuminate_from(light, at.points, std::vector{place}, from);
    sum += glm::dvec3(from.arriving.Cl[0]) * std::max(0.0, double(glm::dot(N, from.arriving.L[0])));
  }
  return sum / double(places.size());
}
/// Over the places where rays are cast.
inline glm::dvec3 quadrature(const BoundLight& light, const glm::vec3& P, const glm::vec3& N) {
  return quadrature(light, light.places, P, N);
}
/// Over those that shares relate to.
inline glm::dvec3 open_quadrature(const BoundLight& light, const glm::vec3& P, const glm::vec3& N) {
  return quadrature(light, light.open_places, P, N);
}

/// Shares of many places at one point.
inline ShareSamples shares(const LitScene& scene, const glm::vec3& P, const glm::vec3& N,
                           const std::vector<glm::vec2>& xi) {
  const BarePoints at(std::vector<glm::vec3>(xi.size(), P), N);
  ShareSamples out;
  scene.light().definition->share_from(scene.light(), at.points, xi, scene.services(), out);
  return out;
}

inline double mean_share(const ShareSamples& samples, int component = 0) {
  double sum = 0.0;
  for (int i = 0; i < samples.share.count(); ++i) sum += double(samples.share[i][component]);
  return sum / samples.share.count();
}

}  // namespace tessera::test
