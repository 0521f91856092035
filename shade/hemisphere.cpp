#include "shade/hemisphere.h"

#include <algorithm>
#include <cmath>

#include "cameras/camera.h"
#include "cameras/concentric.h"
#include "shade/mathematics.h"

namespace tessera {
namespace {

bool all_finite(const glm::vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Unit tangents of the unit vector N, without a singular direction (T. Duff et al., "Building an
/// orthonormal basis, revisited", JCGT 6(1), 2017).
struct Tangents {
  glm::vec3 x, y;

  explicit Tangents(const glm::vec3& N) {
    const float sign = std::copysign(1.0f, N.z);
    const float a = -1.0f / (sign + N.z), b = N.x * N.y * a;
    x = {1.0f + sign * N.x * N.x * a, sign * b, -sign * N.x};
    y = {b, sign + N.y * N.y * a, -N.y};
  }
};

/// Camera units.
float reach_of(const BoundLight& light, const LightServices& services) {
  const float world = light.parameters.scalar("maxdistance");
  if (std::isnan(world)) return std::numeric_limits<float>::infinity();
  if (!services.camera) return std::max(world, 0.0f);
  const glm::dmat3 axes(services.camera->camera_from_world(0.0f));
  return float(std::max(double(world), 0.0) * std::cbrt(std::abs(glm::determinant(axes))));
}

/// Pixels along x and y that a shift of a point by one unit along each camera axis within the
/// tangent plane of N makes; zero where the point has no place on the raster.
struct RasterGradients {
  glm::vec3 x{0.0f}, y{0.0f};

  RasterGradients(const Camera& camera, const glm::vec3& P, const glm::vec3& N) {
    const RasterClipMap& map = camera.raster_clip();
    const float w = camera.raster_clip_from_camera(P).z;
    if (!(w > 0.0f)) return;
    // raster x = x_scale * x / W + x_from_w, where W depends on z alone.
    const float w_change = map.w_from_z / w;
    const glm::vec3 of_x = map.x_scale / w * glm::vec3(1.0f, 0.0f, -P.x * w_change);
    const glm::vec3 of_y = map.y_scale / w * glm::vec3(0.0f, 1.0f, -P.y * w_change);
    const glm::vec3 along_x = of_x - N * glm::dot(N, of_x), along_y = of_y - N * glm::dot(N, of_y);
    if (all_finite(along_x) && all_finite(along_y)) x = along_x, y = along_y;
  }
};

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
  if (!all_finite(N) || N == glm::vec3(0.0f)) return glm::vec3(0.0f);
  const ConcentricPoint disc = concentric_from_square(xi.x, xi.y);
  const float angle = 2.0f * pi * disc.turn;
  const float height = std::sqrt(std::max(0.0f, 1.0f - disc.radius * disc.radius));
  const Tangents tangents(N);
  return disc.radius * (std::cos(angle) * tangents.x + std::sin(angle) * tangents.y) + height * N;
}

Rays hemisphere_rays(const BoundLight& light, const ShadingPoints& points,
                     std::span<const glm::vec2> xi, const LightServices& services) {
  Rays rays(points.count);
  std::ranges::fill(rays.far, reach_of(light, services));
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
  for (int i = 0; i < rays.count(); ++i) {
    const RasterGradients pixels(camera, rays.origin[i], N[i]);
    const glm::vec3 direction = rays.direction[i];
    for (size_t axis = 0; axis < 2; ++axis) {
      const glm::vec3& gradient = axis == 0 ? pixels.x : pixels.y;
      const float extent = disc_spread * glm::length(gradient);
      if (!(extent > 0.0f) || !std::isfinite(extent)) continue;
      const float y = glm::dot(gradient / extent, direction);
      out.extent[axis][size_t(i)] = extent;
      out.y[axis][size_t(i)] = std::clamp(y, -farthest_coordinate, farthest_coordinate);
    }
  }
}

void mean_share(const BoundLight& light, const ShadingPoints& points,
                std::span<const glm::vec2> places, const LightServices& services, Vec3Array& out) {
  out.reset(points.count);
  ShareSamples at_place;
  std::vector<glm::vec2> xi(size_t(points.count));
  for (const glm::vec2& place : places) {
    std::ranges::fill(xi, place);
    at_place.reset(points.count);
    light.definition->share_from(light, points, xi, services, at_place);
    for (int i = 0; i < points.count; ++i) out.add(i, at_place.share[i] / float(places.size()));
  }
}

}  // namespace tessera
