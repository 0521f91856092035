#include "shade/light_shadows.h"

#include <algorithm>
#include <cmath>

#include "shade/camera_motion.h"
#include "shade/extended_light.h"
#include "shade/mathematics.h"
#include "shade/ray_shadows.h"
#include "shade/shadow_source.h"

namespace tessera {
namespace {

void shadow_map_transmission(const BoundLight& light, const ShadingPoints& points,
                             std::span<float> share) {
  const auto finite = [&](const char* name, float otherwise) {
    const float value = light.parameters.scalar(name);
    return std::isfinite(value) ? value : otherwise;
  };
  const ShadowFilter filter{place_count(light.parameters), std::max(0.0f, finite("width", 1.0f)),
                            std::max(0.0f, finite("blur", 0.0f)), finite("bias", 0.0f)};
  light.shadow->light_share(points, filter, share);
}

void ray_transmission(const BoundLight& light, const ShadingPoints& points,
                      const Vec3Array& towards, bool infinite, std::span<float> share) {
  PlaceShadows shadows;
  const RayTracer* tracer = light.services ? light.services->rays : nullptr;
  trace_shadows(tracer, points, towards, infinite, shadows);
  std::ranges::copy(shadows.share, share.begin());
}

CameraMotion camera_motion(const BoundLight& light) {
  return CameraMotion(light.services ? light.services->camera : nullptr);
}

}  // namespace

std::vector<ParameterDeclaration> with_shadow_parameters(std::vector<ParameterDeclaration> own) {
  const ParameterDeclaration shadow[] = {
      string_parameter("shadowname", "",
                       "depth map from the light, or raytrace; empty: no shadows"),
      scalar_parameter("samples", 16.0f, "places of the map compared for a point"),
      scalar_parameter("width", 1.0f, "of the filter, in shading cells"),
      scalar_parameter("blur", 0.0f, "further width of the filter, share of the map"),
      scalar_parameter("bias", 0.0f,
                       "how much nearer than the surface a blocker must be, "
                       "besides a texel"),
      string_parameter("shadowrate", "",
                       "shadows once a cell, pixel or sample; empty: a sample for rays where "
                       "surfaces move, otherwise a cell")};
  own.insert(own.end(), std::begin(shadow), std::end(shadow));
  return own;
}

void transmission_from_point(const BoundLight& light, const ShadingPoints& points,
                             std::span<float> share) {
  if (!light.ray_traced) return shadow_map_transmission(light, points, share);
  const glm::vec3 from = light.parameters.vec3("from");
  const CameraMotion camera = camera_motion(light);
  const bool moves = camera.concerns(points);
  Vec3Array towards(points.count);
  for (int i = 0; i < points.count; ++i) {
    glm::vec3 from_now = from;
    if (moves) from_now = camera.now_from_open(points.time[i]) * glm::dvec4(from, 1.0);
    towards.set(i, from_now - points.P[i]);
  }
  ray_transmission(light, points, towards, false, share);
}

void transmission_from_distance(const BoundLight& light, const ShadingPoints& points,
                                std::span<float> share) {
  if (!light.ray_traced) return shadow_map_transmission(light, points, share);
  const glm::vec3 L = unit_or_zero(light.parameters.vec3("from") - light.parameters.vec3("to"));
  const CameraMotion camera = camera_motion(light);
  const bool moves = camera.concerns(points);
  Vec3Array towards(points.count);
  for (int i = 0; i < points.count; ++i) {
    glm::vec3 L_now = L;
    if (moves) L_now = glm::dmat3(camera.now_from_open(points.time[i])) * glm::dvec3(L);
    towards.set(i, L_now);
  }
  ray_transmission(light, points, towards, true, share);
}

TermRate term_rate(std::string_view name) {
  if (name == "cell") return TermRate::cell;
  if (name == "pixel") return TermRate::pixel;
  if (name == "sample") return TermRate::sample;
  throw Error(fmt::format("unknown shadowrate \"{}\"; expected one of: cell, pixel, sample", name));
}

}  // namespace tessera
