#include <algorithm>
#include <cmath>
#include <vector>

#include "base/error.h"
#include "shade/extended_light.h"
#include "shade/latitude_longitude.h"
#include "shade/textures.h"

namespace tessera {
namespace {

LightExtent measure(const BoundParameters& parameters, const glm::dmat4& camera_from_light) {
  const double determinant = glm::determinant(glm::dmat3(camera_from_light));
  if (!parameters.string("texturename").empty() && !(std::abs(determinant) > 0.0)) {
    throw Error("its map needs a transform that has an inverse, found one that has none");
  }
  return {.half_axes = {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1)},
          .round = true,
          .infinite = true};
}

/// Look-ups in a map of the light's surroundings, each filtered over a part of the directions.
class MapLookups {
 public:
  MapLookups(const BoundLight& light, int count)
      : light_(light),
        light_from_camera_(glm::inverse(glm::dmat3(light.camera_from_light))),
        zeros_(size_t(count), 0.0f) {
    for (auto* values : {&s_, &t_, &dsdx_, &dtdy_}) values->resize(size_t(count));
  }
  /// Look-up i is in the unit direction L, over `solid_angle` about it.
  void set(int i, const glm::vec3& L_camera, float solid_angle) {
    const glm::vec3 d = unit_or_zero(glm::vec3(light_from_camera_ * glm::dvec3(L_camera)));
    const glm::vec2 st = st_of_direction(d);
    const float width_radians = std::sqrt(solid_angle);
    // A circle of directions spans more longitude near the poles.
    const float sine = std::max(1e-3f, std::sqrt(std::max(0.0f, 1.0f - d.z * d.z)));
    const size_t k = size_t(i);
    s_[k] = st.x, t_[k] = st.y;
    dsdx_[k] = std::min(1.0f, width_radians / (2.0f * pi * sine));
    dtdy_[k] = std::min(1.0f, width_radians / pi);
  }
  /// Multiplies Cl by what the map holds.
  void look_up(Vec3Array& Cl) const {
    const TextureRequest request{.file = light_.parameters.string("texturename"),
                                 .t_wrap = TextureWrap::clamp};
    const Vec3Array found = light_.services->textures->color(
        request, {s_, t_, dsdx_, zeros_, zeros_, dtdy_}, light_.where);
    for (int i = 0; i < Cl.count(); ++i) Cl.set(i, Cl[i] * found[i]);
  }

 private:
  const BoundLight& light_;
  glm::dmat3 light_from_camera_;
  std::vector<float> zeros_, s_, t_, dsdx_, dtdy_;
};

bool has_map(const BoundLight& light) {
  return light.services && light.services->textures &&
         !light.parameters.string("texturename").empty();
}

/// Directions are spread over the hemisphere about N with the density of the cosine, so that each
/// counts the same for a diffuse surface and Cl carries 1 / cosine.
void illuminate_from(const BoundLight& light, const ShadingPoints& points,
                     std::span<const glm::vec2> xi, PlaceSamples& out) {
  const glm::vec3 radiance = radiance_of(light.parameters);
  const bool mapped = has_map(light);
  MapLookups lookups(light, mapped ? points.count : 0);
  for (int i = 0; i < points.count; ++i) {
    const glm::vec3 N = points.N[i];
    if (N == glm::vec3(0.0f)) continue;
    const glm::vec2 disc = disc_from_square(xi[size_t(i)]);
    const float cosine = std::sqrt(std::max(1e-6f, 1.0f - glm::dot(disc, disc)));
    const auto [x, y] = tangents(glm::dvec3(N));
    const glm::vec3 tangent = disc.x * glm::vec3(x) + disc.y * glm::vec3(y);
    const glm::vec3 L = unit_or_zero(tangent + cosine * N);
    out.arriving.L.set(i, L);
    const float per_cosine = 1.0f / std::max(glm::dot(N, L), 1e-3f);
    out.arriving.Cl.set(i, radiance * per_cosine);
    out.towards.set(i, L);
    out.offset.set(i, tangent);
    // Of the hemisphere, what one of the light's places stands for.
    if (mapped) lookups.set(i, L, pi * per_cosine / float(light.places.size()));
  }
  if (!mapped) return;
  lookups.look_up(out.arriving.Cl);
  out.texture_lookups = uint64_t(points.count);
}

}  // namespace

LightDefinition light_domelight() {
  return {.name = "domelight",
          .help = "light from infinitely far away, all round",
          .parameters = with_extent_parameters({string_parameter(
              "texturename", "", "latitude-longitude map that multiplies it; empty: none")}),
          .illuminate_from = illuminate_from,
          .measure = measure,
          .share_from = share_from_extent};
}

}  // namespace tessera
