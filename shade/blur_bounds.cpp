#include "shade/blur_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "dice/bounds_kernel.h"
#include "shade/velocity_kernel.h"

namespace tessera {
namespace {

double cross(glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; }

/// The float next to `value` on the side of 0; `value` is not negative.
float rounded_down(double value) {
  if (value >= double(std::numeric_limits<float>::max())) return std::numeric_limits<float>::max();
  const float nearest = float(value);
  return double(nearest) > value ? std::nextafter(nearest, 0.0f) : nearest;
}

float rounded_up(double value) {
  const float nearest = float(value);
  return double(nearest) < value ? std::nextafter(nearest, 1e30f) : nearest;
}

/// Depth range over all keys; `in_front` and `finite` say whether anything can be bounded.
VertexBounds vertex_bounds(const Grid& grid, const RasterClipMap& map) {
  VertexBounds bounds;
  for (int key = 0; key < grid.key_count(); ++key)
    add_vertex_bounds(map, 0.0f, grid.P(key, 0), grid.P(key, 1), grid.P(key, 2),
                      size_t(grid.vertex_count()), bounds);
  return bounds;
}

/// Least radius of the circle of confusion over depths [z_min, z_max] with W > 0. The signed radius
/// is monotonic in depth: an affine function of 1 / z, or of z under an orthographic projection.
float least_coc(const RasterClipMap& map, const AffineInZ& coc, double z_min, double z_max) {
  const auto radius = [&](double z) {
    return (double(coc.scale) * z + double(coc.offset)) /
           (double(map.w_from_z) * z + double(map.w_constant));
  };
  const double near = radius(z_min), far = radius(z_max);
  if (!(std::min(near, far) > 0.0 || std::max(near, far) < 0.0)) return 0.0f;
  constexpr double rounding = 1.0 - 1e-15;  // products are exact; the sum and the quotient are not
  return rounded_down(std::min(std::abs(near), std::abs(far)) * rounding);
}

/// Point of the segment ab nearest to the origin.
glm::dvec2 nearest_on_segment(glm::dvec2 a, glm::dvec2 b) {
  const glm::dvec2 side = b - a;
  const double length_squared = glm::dot(side, side);
  if (!(length_squared > 0.0)) return a;
  return a + side * std::clamp(-glm::dot(a, side) / length_squared, 0.0, 1.0);
}

/// A line through the origin that all velocities lie on one side of.
struct Separation {
  glm::dvec2 normal{1.0, 0.0};  ///< unit
  double distance = 0.0;        ///< dot(normal, velocity) is nowhere less; 0: none was found
};

/// Distance of the convex hull from the origin, from below: the least of dot(n, velocity) for the
/// best unit n found. Gilbert, Johnson and Keerthi's search: the segment of the hull nearest the
/// origin so far is replaced by a nearer one through the vertex farthest towards the origin.
Separation separate(const Velocities& velocities, const VelocityBox& box, double tolerance) {
  constexpr int most_steps = 24;
  constexpr double close_enough = 0.999;
  Separation best;
  glm::dvec2 nearest = 0.5 * (box.low + box.high);  // a first guess at where the hull lies
  if (!(glm::length(nearest) > tolerance)) nearest = {1.0, 0.0};
  glm::dvec2 a{0.0}, b{0.0};
  for (int step = 0; step < most_steps; ++step) {
    const double length = glm::length(nearest);
    if (!(length > tolerance)) break;  // the origin lies on the segment
    const glm::dvec2 normal = nearest / length;
    const glm::dvec2 support = velocities[least_along(velocities, normal)];
    const double distance = glm::dot(normal, support) - tolerance;
    if (distance > best.distance) best = {normal, distance};
    if (step == 0) {
      a = b = nearest = support;
      continue;
    }
    if (best.distance >= close_enough * length) break;
    // The support lies beyond ab, seen from the far side; the hull's nearest point is on one of the
    // new sides, unless the origin is inside the triangle.
    const double ab = cross(a, b), bs = cross(b, support), sa = cross(support, a);
    if (ab * bs > 0.0 && bs * sa > 0.0) break;
    const glm::dvec2 on_a = nearest_on_segment(a, support), on_b = nearest_on_segment(b, support);
    const bool nearer_a = glm::dot(on_a, on_a) <= glm::dot(on_b, on_b);
    (nearer_a ? b : a) = support;
    nearest = nearer_a ? on_a : on_b;
  }
  return best;
}

/// Centre and half span of the smallest arc of directions that holds all velocities.
void set_directions(const Velocities& velocities, const Separation& separation,
                    BlurBounds& bounds) {
  const ArcEnds ends = arc_ends(velocities, separation.normal);
  const glm::dvec2 first = glm::normalize(velocities[ends.least]);
  const glm::dvec2 last = glm::normalize(velocities[ends.greatest]);
  bounds.direction = glm::vec2(glm::normalize(first + last));
  // Measured from the direction as it is after rounding.
  const glm::dvec2 centre(bounds.direction);
  const auto angle = [&](glm::dvec2 v) {
    return std::abs(std::atan2(cross(centre, v), glm::dot(centre, v)));
  };
  constexpr double rounding = 1e-15;
  bounds.half_span_radians = rounded_up(std::max(angle(first), angle(last)) + rounding);
}

void set_motion(const Grid& grid, const RasterClipMap& map, BlurBounds& bounds) {
  const size_t count = size_t(grid.vertex_count()), segments = size_t(grid.key_count()) - 1;
  const size_t run = segments * count + velocity_padding;
  const auto storage = std::make_unique_for_overwrite<double[]>(2 * run);
  double *const x = storage.get(), *const y = x + run;
  for (size_t s = 0; s < segments; ++s) {
    const auto positions = [&](size_t key) {
      return KeyPositions{grid.P(int(key), 0), grid.P(int(key), 1), grid.P(int(key), 2)};
    };
    const double duration = double(grid.key_times[s + 1]) - double(grid.key_times[s]);
    if (!(duration > 0.0)) return;
    slowest_velocities(map, positions(s), positions(s + 1), duration, count, x + s * count,
                       y + s * count);
  }
  const Velocities velocities{x, y, segments * count};
  const VelocityBox box = velocity_box(velocities);
  const glm::dvec2 extremes = glm::max(glm::abs(box.low), glm::abs(box.high));
  const double largest = std::max(extremes.x, extremes.y);
  // Squares of velocities must neither overflow nor vanish; these are not speeds of any scene.
  if (!box.finite || !(largest > 1e-100 && largest < 1e100)) return;
  // Rounding of velocities and of products with a unit vector: a few ulps of the largest.
  const Separation separation = separate(velocities, box, 4e-15 * largest);
  if (!(separation.distance > 0.0)) return;
  set_directions(velocities, separation, bounds);
  // All lie on one side of a line through the origin; only rounding can make a half turn of that.
  if (bounds.half_span_radians <= 0.5f * std::numbers::pi_v<float>)
    bounds.min_speed = rounded_down(separation.distance);
}

}  // namespace

BlurBounds blur_bounds(const Grid& grid, const Camera& camera, bool motion, bool lens) {
  BlurBounds bounds;
  const bool moves = motion && grid.key_count() > 1, blurs = lens && camera.lens_open();
  if (!moves && !blurs) return bounds;
  const RasterClipMap& map = camera.raster_clip();
  const VertexBounds vertices = vertex_bounds(grid, map);
  if (!vertices.in_front || !vertices.finite) return bounds;
  if (blurs)
    bounds.min_coc = std::min(least_coc(map, map.coc_x, vertices.z_min, vertices.z_max),
                              least_coc(map, map.coc_y, vertices.z_min, vertices.z_max));
  if (moves) set_motion(grid, map, bounds);
  return bounds;
}

}  // namespace tessera
