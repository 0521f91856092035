#include "shade/hemisphere.h"

#include <algorithm>
#include <cmath>

#include "cameras/camera.h"
#include "shade/mathematics.h"
#include "shade/receiver_frame.h"

namespace tessera {
namespace {

/// Camera units.
float longest_ray(const BoundLight& light, const LightServices& services) {
  const float world = light.parameters.scalar("maxdistance");
  if (std::isnan(world)) return std::numeric_limits<float>::infinity();
  if (!services.camera) return std::max(world, 0.0f);
  const glm::dmat3 axes(services.camera->camera_from_world(0.0f));
  return float(std::max(double(world), 0.0) * std::cbrt(std::abs(glm::determinant(axes))));
}

}  // namespace

std::vector<ParameterDeclaration> hemisphere_parameters() {
  return {scalar_parameter("intensity", 1.0f, "multiplies the colour"),
          color_parameter("lightcolor", glm::vec3(1.0f), "colour"),
          scalar_parameter("maxdistance", 1e30f, "how far rays go, world units"),
          scalar_parameter("samples", 16.0f, "rays for a cell at rate cell"),
          string_parameter("shadowrate", "sample", "rays once a cell, pixel or sample")};
}

void illuminate_hemisphere(const BoundParameters& parameters, const ShadingPoints& points,
                           LightSamples& out) {
  const glm::vec3 color = parameters.scalar("intensity") * parameters.vec3("lightcolor");
  for (int i = 0; i < points.count; ++i) out.Cl.set(i, color);
}

glm::vec3 cosine_direction(const glm::vec3& N, const glm::vec2& xi) {
  if (!is_finite(N) || N == glm::vec3(0.0f)) return glm::vec3(0.0f);
  const glm::vec2 disc = disc_from_square(xi);
  const float height = std::sqrt(std::max(0.0f, 1.0f - glm::dot(disc, disc)));
  const auto [x, y] = tangents(glm::dvec3(N));
  return disc.x * glm::vec3(x) + disc.y * glm::vec3(y) + height * N;
}

Rays hemisphere_rays(const BoundLight& light, const ShadingPoints& points,
                     std::span<const glm::vec2> xi, const LightServices& services) {
  Rays rays(points.count);
  std::ranges::fill(rays.far, longest_ray(light, services));
  for (int i = 0; i < points.count; ++i) {
    rays.origin.set(i, points.P[i]);
    rays.direction.set(i, cosine_direction(points.N[i], xi[size_t(i)]));
  }
  if (points.time) std::copy_n(points.time, points.count, rays.time.begin());
  if (points.surface) std::copy_n(points.surface, points.count, rays.surface.begin());
  return rays;
}

void fill_hemisphere_coordinates(const Camera& camera, const Rays& rays, const Vec3Input& N,
                                 ShareSamples& out) {
  const LightExtent all_round{.infinite = true};
  for (int i = 0; i < rays.count(); ++i) {
    const ReceiverFrame frame = ReceiverFrame::at(camera, rays.origin[i], N[i]);
    const glm::vec2 pixels = frame.pixels(rays.direction[i]);
    set_coordinate(size_t(i), effect_coordinate(pixels, reach_of(all_round, frame)), out);
  }
}

void mean_share(const BoundLight& light, const ShadingPoints& points,
                std::span<const glm::vec2> places, const LightServices& services, Vec3Array& out) {
  out.reset(points.count);
  ShareSamples at_place;
  std::vector<glm::vec2> xi(size_t(points.count));
  const float weight = 1.0f / float(places.size());
  for (const glm::vec2& place : places) {
    std::ranges::fill(xi, place);
    at_place.reset(points.count);
    light.definition->share_from(light, points, xi, services, at_place);
    for (int i = 0; i < points.count; ++i) out.add(i, weight * at_place.share[i]);
  }
}

}  // namespace tessera
