#include "shade/surface_shading.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "shade/extended_light.h"
#include "shade/mathematics.h"

namespace tessera {
namespace {

/// `opacity` clamped to [0, 1]; a NaN becomes 1.
glm::vec3 clamped(const glm::vec3& opacity) {
  glm::vec3 result;
  for (int c = 0; c < 3; ++c) {
    result[c] = opacity[c] < 0.0f ? 0.0f : (opacity[c] < 1.0f ? opacity[c] : 1.0f);
  }
  return result;
}

/// Returns how many points were dropped.
uint64_t drop_nonfinite(const ShadingPoints& points, FailedPoint failed, SurfaceColors& out) {
  const auto all_finite = [&](int i) {
    return is_finite(out.Ci[i]) && is_finite(out.Oi[i]) &&
           std::ranges::all_of(out.light_terms, [&](const auto& t) { return is_finite(t[i]); });
  };
  const glm::vec3 color(failed == FailedPoint::black ? 0.0f
                                                     : std::numeric_limits<float>::quiet_NaN());
  uint64_t dropped = 0;
  for (int i = 0; i < points.count; ++i) {
    if (all_finite(i)) {
      out.Oi.set(i, clamped(out.Oi[i]));
      continue;
    }
    out.Ci.set(i, color);
    out.Oi.set(i, clamped(points.Os[i]));
    for (Vec3Array& term : out.light_terms) term.set(i, glm::vec3(0.0f));
    ++dropped;
  }
  return dropped;
}

/// Adds what a surface that is part of a light sends towards the eye itself.
void add_own_light(const BoundLight& light, const ShadingPoints& points, SurfaceColors& out) {
  const glm::vec3 radiance = radiance_of(light.parameters);
  const bool double_sided = light.parameters.scalar("doublesided") != 0.0f;
  for (int i = 0; i < points.count; ++i) {
    const bool faces_eye = glm::dot(points.N[i], points.I[i]) < 0.0f;
    if (faces_eye || double_sided) out.Ci.add(i, radiance * out.Oi[i]);
  }
}

}  // namespace

void shade_surface(const ShaderBindings& bindings, const SurfaceBinding& surface,
                   const ShadingPoints& points, FailedPoint failed, SurfaceColors& out,
                   ShadeCounters& counters) {
  out.Ci.reset(points.count);
  out.Oi.reset(points.count);
  out.light_terms.resize(bindings.light_term_count());
  for (Vec3Array& term : out.light_terms) term.reset(points.count);
  const ShaderDefinition& definition = *surface.surface.definition;
  const ShaderContext context(surface.surface, points,
                              {surface.lights, &bindings.textures(), &counters});
  definition.surface(context, out);
  if (surface.shines) add_own_light(*surface.shines, points, out);
  counters.points_shaded += uint64_t(points.count);
  report_dropped(bindings, surface, drop_nonfinite(points, failed, out), counters);
}

void report_dropped(const ShaderBindings& bindings, const SurfaceBinding& surface, uint64_t dropped,
                    ShadeCounters& counters) {
  if (dropped == 0) return;
  counters.nonfinite_dropped += dropped;
  const ShaderDefinition& definition = *surface.surface.definition;
  bindings.diagnostics().warn_once(
      "nonfinite " + definition.name, surface.surface.where,
      fmt::format("surface shader \"{}\" gave values that are not finite; such points are dropped",
                  definition.name));
}

}  // namespace tessera
