#include "shade/surface_shading.h"

#include <cmath>

namespace tessera {
namespace {

bool finite(const glm::vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// `opacity` clamped to [0, 1]; a NaN becomes 1.
glm::vec3 clamped(const glm::vec3& opacity) {
  glm::vec3 result;
  for (int c = 0; c < 3; ++c) {
    result[c] = opacity[c] < 0.0f ? 0.0f : (opacity[c] < 1.0f ? opacity[c] : 1.0f);
  }
  return result;
}

/// Returns how many points were dropped.
uint64_t drop_nonfinite(const ShadingPoints& points, SurfaceColors& out) {
  uint64_t dropped = 0;
  for (int i = 0; i < points.count; ++i) {
    if (finite(out.Ci[i]) && finite(out.Oi[i])) {
      out.Oi.set(i, clamped(out.Oi[i]));
      continue;
    }
    out.Ci.set(i, glm::vec3(0.0f));
    out.Oi.set(i, clamped(points.Os[i]));
    ++dropped;
  }
  return dropped;
}

}  // namespace

void shade_surface(const ShaderBindings& bindings, const SurfaceBinding& surface,
                   const ShadingPoints& points, SurfaceColors& out, ShadeCounters& counters) {
  out.Ci.reset(points.count);
  out.Oi.reset(points.count);
  const ShaderDefinition& definition = *surface.surface.definition;
  const ShaderContext context(surface.surface, points,
                              {surface.lights, &bindings.textures(), &counters});
  definition.surface(context, out);
  counters.points_shaded += uint64_t(points.count);
  const uint64_t dropped = drop_nonfinite(points, out);
  if (dropped == 0) return;
  counters.nonfinite_dropped += dropped;
  bindings.diagnostics().warn_once(
      "nonfinite " + definition.name, surface.surface.where,
      fmt::format("surface shader \"{}\" gave values that are not finite; such points are dropped",
                  definition.name));
}

}  // namespace tessera
