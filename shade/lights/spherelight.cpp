#include <algorithm>
#include <cmath>

#include "shade/extended_light.h"
#include "shade/light_extent.h"
#include "shade/mathematics.h"

namespace tessera {
namespace {

/// The light as a unit ball: `camera_from_ball` makes of it the ellipsoid that is seen.
struct Ball {
  glm::dvec3 centre;
  glm::dmat3 camera_from_ball, ball_from_camera;
  double volume_ratio;

  explicit Ball(const LightExtent& extent)
      : centre(extent.centre),
        camera_from_ball(glm::dvec3(extent.half_axes[0]), glm::dvec3(extent.half_axes[1]),
                         glm::dvec3(extent.half_axes[2])),
        ball_from_camera(glm::inverse(camera_from_ball)),
        volume_ratio(std::abs(glm::determinant(camera_from_ball))) {}
};

/// A place of the ball as it is seen from a point outside.
struct BallPlace {
  glm::dvec3 towards{0.0};   ///< camera space
  double solid_angle = 0.0;  ///< that the place stands for, as the mean over places; 0: not seen
};

/// Directions evenly spread over the cone that the unit ball fills seen from `P_ball`. The
/// transform takes a solid angle dw about the unit direction d to |det M| / |M d|^3 dw about M d.
BallPlace place_of(const Ball& ball, const glm::dvec3& P_camera, const glm::vec2& xi) {
  const glm::dvec3 to_centre = ball.ball_from_camera * (ball.centre - P_camera);
  const double squared = glm::dot(to_centre, to_centre);
  if (!(squared >= 1.0) || !std::isfinite(squared)) return {};  // the light shines outward
  const double distance = std::sqrt(squared), widest_sine = 1.0 / distance;
  const glm::dvec3 axis = to_centre / distance;
  // 1 - cos of the cone, as sin^2 / (1 + cos): small angles keep their digits.
  const double height =
      widest_sine * widest_sine / (1.0 + std::sqrt(std::max(0.0, 1.0 - 1.0 / squared)));
  const glm::dvec2 disc(disc_from_square(xi));
  const double r2 = std::min(glm::dot(disc, disc), 1.0);
  const double dip = height * r2, cosine = 1.0 - dip;  // evenly spread over [0, height]
  // Of the disc's radius r becomes the sine sqrt(dip (2 - dip)).
  const glm::dvec2 tangent = disc * std::sqrt(height * (2.0 - dip));
  const auto [x, y] = tangents(axis);
  const glm::dvec3 direction = cosine * axis + tangent.x * x + tangent.y * y;
  const double sine2 = dip * (2.0 - dip);
  const double along = distance * cosine - std::sqrt(std::max(0.0, 1.0 - squared * sine2));
  const glm::dvec3 in_camera = ball.camera_from_ball * direction;
  const double stretch = glm::length(in_camera);
  return {std::max(along, 0.0) * in_camera,
          2.0 * double(pi) * height * ball.volume_ratio / (stretch * stretch * stretch)};
}

void illuminate_from(const BoundLight& light, const ShadingPoints& points,
                     std::span<const glm::vec2> xi, PlaceSamples& out) {
  const glm::vec3 radiance = radiance_of(light.parameters);
  const Ball ball(light.extent);
  for (int i = 0; i < points.count; ++i) {
    const glm::dvec3 P(points.P[i]);
    const BallPlace place = place_of(ball, P, xi[size_t(i)]);
    const double length = glm::length(place.towards);
    if (!(place.solid_angle > 0.0) || !(length > 0.0)) continue;
    out.arriving.L.set(i, glm::vec3(place.towards / length));
    out.arriving.Cl.set(i, radiance * float(place.solid_angle / double(pi)));
    out.towards.set(i, glm::vec3(place.towards));
    out.offset.set(i, glm::vec3(P + place.towards - ball.centre));
  }
}

LightExtent measure(const BoundParameters& parameters, const glm::dmat4& camera_from_light) {
  return ball_extent(positive_size(parameters, "radius"), camera_from_light);
}

}  // namespace

/// Places are spread over what is seen of the ball rather than over its surface, half of which is
/// turned away: so far from the light all places count the same.
LightDefinition light_spherelight() {
  return {.name = "spherelight",
          .help = "a ball about the origin of the light's space that shines outward",
          .parameters = with_extent_parameters({scalar_parameter("radius", 1.0f, "of the ball")}),
          .illuminate_from = illuminate_from,
          .measure = measure,
          .share_from = share_from_extent};
}

}  // namespace tessera
