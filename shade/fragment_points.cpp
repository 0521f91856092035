#include "shade/fragment_points.h"

#include <algorithm>
#include <cmath>

#include "shade/view.h"

namespace tessera {
namespace {

/// A pixel on a surface seen at a smaller angle than this is taken as seen at this one: its
/// footprint stays bounded.
constexpr float least_cosine = 0.05f;

struct PlacedPoint {
  glm::vec3 P, N;
};

/// From a fragment's flat triangle to the curved surface, at shutter open. Halfway to the mean of
/// its projections onto the corners' tangent planes, which is exact for a parabola (compare T.
/// Boubekeur, M. Alexa, "Phong tessellation", SIGGRAPH Asia 2008).
glm::vec3 lift_of(const FragmentGeometry& seen, const glm::vec3& P) {
  const Grid& grid = *seen.grid;
  glm::vec3 lift(0.0f);
  for (size_t k = 0; k < 3; ++k) {
    const int corner = seen.corner[k];
    const glm::vec3 Q(grid.P(0, 0)[corner], grid.P(0, 1)[corner], grid.P(0, 2)[corner]);
    const glm::vec3 N(grid.N(0)[corner], grid.N(1)[corner], grid.N(2)[corner]);
    lift += seen.weight[k] * glm::dot(Q - P, N) * N;
  }
  return 0.5f * lift;
}

/// Two edges of a triangle and its unit normal.
struct TriangleFrame {
  glm::dvec3 edge_b, edge_c, normal;
  bool valid = false;

  TriangleFrame(const FragmentGeometry& seen, float t) {
    const KeyBlend at(*seen.grid, t);
    const glm::dvec3 a(vertex_camera(*seen.grid, seen.corner[0], at));
    edge_b = glm::dvec3(vertex_camera(*seen.grid, seen.corner[1], at)) - a;
    edge_c = glm::dvec3(vertex_camera(*seen.grid, seen.corner[2], at)) - a;
    normal = glm::cross(edge_b, edge_c);
    const double length = glm::length(normal);
    valid = length > 0.0 && std::isfinite(length);
    if (valid) normal /= length;
  }
};

/// What becomes of `v` when the triangle moves; `v` itself where it has no area. Rigid motion turns
/// it as it turns the triangle.
glm::vec3 carried(const glm::vec3& v, const TriangleFrame& from, const TriangleFrame& to) {
  if (!from.valid || !to.valid) return v;
  const glm::dvec3 whole(v);
  const double height = glm::dot(whole, from.normal);
  // Coordinates by the dual basis: (edge_c x normal) / area and (normal x edge_b) / area.
  const double area = glm::dot(glm::cross(from.edge_b, from.edge_c), from.normal);
  const double b = glm::dot(whole, glm::cross(from.edge_c, from.normal)) / area;
  const double c = glm::dot(whole, glm::cross(from.normal, from.edge_b)) / area;
  return glm::vec3(b * to.edge_b + c * to.edge_c + height * to.normal);
}

PlacedPoint at_open(const FragmentGeometry& seen) {
  const glm::vec3 P = seen.P_camera(0.0f);
  return {P + lift_of(seen, P), unit_normal(seen)};
}

/// `now` is the frame of the fragment's triangle at its time.
PlacedPoint at_time(const FragmentGeometry& seen, const TriangleFrame& now) {
  if (seen.grid->key_count() == 1) return at_open(seen);
  const TriangleFrame open(seen, 0.0f);
  const glm::vec3 lift = lift_of(seen, seen.P_camera(0.0f));
  return {seen.P_camera(seen.time) + carried(lift, open, now),
          unit_or_zero(carried(unit_normal(seen), open, now))};
}

/// The side of the triangle that the eye sees decides, not where the normal points: at the rim of a
/// smooth surface normals already turn away.
bool points_away(const TriangleFrame& triangle, const PlacedPoint& at, const Camera& camera) {
  const glm::dvec3 from_eye(along_view(camera, at.P));
  const double away = triangle.valid ? glm::dot(triangle.normal, from_eye) : 0.0;
  if (away == 0.0) return glm::dot(glm::dvec3(at.N), from_eye) > 0.0;
  return glm::dot(glm::dvec3(at.N), triangle.normal) * away > 0.0;
}

PlacedPoint at_sample(const FragmentGeometry& seen, const Camera& camera) {
  const TriangleFrame now(seen, seen.time);
  PlacedPoint at = at_time(seen, now);
  if (points_away(now, at, camera)) at.N = -at.N;
  return at;
}

}  // namespace

FragmentPoints::FragmentPoints(const ShadeInput& input, std::span<const uint32_t> fragments,
                               PointTime when, const Camera& camera, bool pixel_footprints)
    : P_(int(fragments.size())), N_(P_.count()) {
  const bool own_time = when == PointTime::of_sample;
  time_.resize(own_time ? fragments.size() : 0);
  surface_.resize(time_.size());
  for (size_t i = 0; i < fragments.size(); ++i) {
    const FragmentGeometry seen(input, fragments[i]);
    const PlacedPoint at = own_time ? at_sample(seen, camera) : at_open(seen);
    P_.set(int(i), at.P);
    N_.set(int(i), at.N);
    if (own_time) time_[i] = seen.time, surface_[i] = int32_t(seen.grid->surface->id);
  }
  points_.count = P_.count();
  points_.P = P_;
  points_.N = N_;
  if (own_time) points_.time = time_.data(), points_.surface = surface_.data();
  if (pixel_footprints) fill_footprints(camera);
}

void FragmentPoints::fill_footprints(const Camera& camera) {
  dPdx_.reset(P_.count()), dPdy_.reset(P_.count());
  for (int i = 0; i < P_.count(); ++i) {
    const glm::vec3 P = P_[i], N = N_[i];
    const glm::vec3 I = view_direction(camera, P);
    const float w = camera.raster_clip_from_camera(P).z;
    const float cosine = glm::dot(N, I);
    const float bounded = std::copysign(std::max(std::abs(cosine), least_cosine), cosine);
    // One pixel sideways at the point's depth, then along the view back to the tangent plane.
    const auto onto_plane = [&](const glm::vec3& step) {
      return step - I * (glm::dot(N, step) / bounded);
    };
    dPdx_.set(i, onto_plane({w / camera.raster_clip().x_scale, 0.0f, 0.0f}));
    dPdy_.set(i, onto_plane({0.0f, w / camera.raster_clip().y_scale, 0.0f}));
  }
  points_.dPdx = dPdx_;
  points_.dPdy = dPdy_;
}

}  // namespace tessera
