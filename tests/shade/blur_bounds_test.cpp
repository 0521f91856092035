/// Bounds of motion and defocus against brute force in quadruple precision: at extreme coordinates
/// the derivative of a quotient cancels more digits than a long double has.

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shade/blur_bounds.h"
#include "tests/hide/hide_fixture.h"

using namespace tessera;

namespace {

using Real = __float128;
constexpr double pi = std::numbers::pi;

struct Velocity {
  Real x, y;

  long double speed() const { return std::hypot((long double)(x), (long double)(y)); }
  long double angle() const { return std::atan2((long double)(y), (long double)(x)); }
};

/// Raster velocity of vertex i at fraction f of segment s: the derivative of (X / W, Y / W).
Velocity velocity(const Grid& grid, const RasterClipMap& map, int s, int i, Real f) {
  const Real duration = Real(grid.key_times[size_t(s) + 1]) - Real(grid.key_times[size_t(s)]);
  const auto at = [&](int axis) {
    return (1 - f) * Real(grid.P(s, axis)[i]) + f * Real(grid.P(s + 1, axis)[i]);
  };
  const auto rate = [&](int axis) {
    return (Real(grid.P(s + 1, axis)[i]) - Real(grid.P(s, axis)[i])) / duration;
  };
  const Real w = map.w_from_z * at(2) + map.w_constant, dw = map.w_from_z * rate(2);
  return {map.x_scale * (rate(0) * w - at(0) * dw) / (w * w),
          map.y_scale * (rate(1) * w - at(1) * dw) / (w * w)};
}

std::vector<Velocity> velocities(const Grid& grid, const RasterClipMap& map, int steps) {
  std::vector<Velocity> all;
  for (int s = 0; s + 1 < grid.key_count(); ++s)
    for (int i = 0; i < grid.vertex_count(); ++i)
      for (int k = 0; k <= steps; ++k)
        all.push_back(velocity(grid, map, s, i, Real(k) / Real(steps)));
  return all;
}

/// Half the smallest arc of directions: what the widest gap between neighbours leaves, radians.
double smallest_half_span(const std::vector<Velocity>& all) {
  std::vector<long double> angles;
  for (const Velocity& v : all) angles.push_back(v.angle());
  std::sort(angles.begin(), angles.end());
  const long double turn = 2 * std::numbers::pi_v<long double>;
  long double gap = angles.front() + turn - angles.back();
  for (size_t i = 0; i + 1 < angles.size(); ++i) gap = std::max(gap, angles[i + 1] - angles[i]);
  return double((turn - gap) / 2);
}

/// Distance from the origin to the convex hull: 0 if no half turn is free of velocities, otherwise
/// that to the nearest segment between any two.
double hull_distance(const std::vector<Velocity>& all) {
  if (smallest_half_span(all) >= pi / 2) return 0;
  double least = std::numeric_limits<double>::infinity();
  for (const Velocity& a : all) {
    for (const Velocity& b : all) {
      const Velocity side{b.x - a.x, b.y - a.y};
      // Where the foot of the perpendicular lies between the ends it counts, otherwise the ends do.
      const Real to_a = a.x * side.x + a.y * side.y, to_b = b.x * side.x + b.y * side.y;
      const bool foot_between = to_a < 0 && to_b > 0;
      const Real area = a.x * b.y - a.y * b.x;
      least = std::min(
          least, double(foot_between ? std::abs((long double)(area)) / side.speed() : a.speed()));
    }
  }
  return least;
}

double angle_between(glm::vec2 direction, const Velocity& v) {
  const Real x = direction.x, y = direction.y;
  return double(std::abs(Velocity{x * v.x + y * v.y, x * v.y - y * v.x}.angle()));
}

/// Checks that the bounds of the motion hold, and are tight. Returns whether it was bounded.
bool check_motion(const Grid& grid, const Camera& camera) {
  const BlurBounds bounds = blur_bounds(grid, camera, true, false);
  const auto ends = velocities(grid, camera.raster_clip(), 1);
  const double distance = hull_distance(ends);
  REQUIRE(std::isfinite(bounds.min_speed));
  REQUIRE(double(bounds.min_speed) <= distance);
  double largest = 0;
  for (const Velocity& v : ends) largest = std::max(largest, double(v.speed()));
  // As far as a float can tell.
  const double representable = std::min(distance, double(std::numeric_limits<float>::max()));
  if (distance > 1e-12 * largest && distance > 1e-37)
    REQUIRE(bounds.min_speed >= 0.99 * representable);
  if (!(bounds.min_speed > 0)) return false;
  REQUIRE(std::abs(glm::length(bounds.direction) - 1.0f) < 1e-6f);
  REQUIRE(bounds.half_span_radians <= float(pi / 2));
  for (const Velocity& v : velocities(grid, camera.raster_clip(), 7)) {
    REQUIRE(double(v.speed()) >= double(bounds.min_speed));
    REQUIRE(angle_between(bounds.direction, v) <= double(bounds.half_span_radians));
  }
  REQUIRE(bounds.half_span_radians <= smallest_half_span(ends) + 1e-6);
  return true;
}

Camera make_camera(Projection projection, double pixel_aspect = 1.0,
                   std::optional<CameraSettings::ThinLens> lens = {}) {
  CameraSettings settings = perspective_settings(640, 480, 50);
  settings.projection = projection;
  settings.pixel_aspect = pixel_aspect;
  settings.lens = lens;
  return Camera(settings);
}

const CameraSettings::ThinLens wide_lens{0.5, 0.2, 5.0};

/// Random patches that move, turn and grow between keys.
std::unique_ptr<Grid> random_grid(std::mt19937& random, int keys, float size, float motion,
                                  float turn) {
  std::uniform_real_distribution<float> even(-1.0f, 1.0f);
  const auto any = [&] { return glm::vec3(even(random), even(random), even(random)); };
  const glm::vec3 centre = 2.0f * any() + glm::vec3(0, 0, 6);
  const glm::vec3 u_side = size * any(), v_side = size * any();
  std::vector<glm::vec3> shift{glm::vec3(0)}, u_turn{glm::vec3(0)}, v_turn{glm::vec3(0)};
  std::vector<float> times{0.0f};
  for (int key = 1; key < keys; ++key) {
    shift.push_back(shift.back() + motion * any());
    u_turn.push_back(turn * any()), v_turn.push_back(turn * any());
    times.push_back(float(key) / float(keys - 1));
  }
  return make_grid(3, 4, times, [=](float u, float v, int k) {
    const size_t key = size_t(k);
    return centre + shift[key] + (u - 0.5f) * (u_side + u_turn[key]) +
           (v - 0.5f) * (v_side + v_turn[key]);
  });
}

}  // namespace

TEST_CASE("bounds of motion hold and are tight over random grids") {
  std::mt19937 random(7);
  int bounded = 0, unbounded = 0;
  for (int i = 0; i < 240; ++i) {
    const bool flat = i % 3 == 0;
    const Camera camera =
        make_camera(flat ? Projection::orthographic : Projection::perspective, 1.0 + i % 2);
    const float turn = i % 5 == 0 ? 1.0f : i % 5 == 1 ? 0.1f : 0.0f;
    const auto grid = random_grid(random, 2 + i % 3, 0.3f, i % 4 == 0 ? 0.02f : 0.5f, turn);
    INFO("grid " << i);
    (check_motion(*grid, camera) ? bounded : unbounded) += 1;
  }
  CHECK(bounded > 60);
  CHECK(unbounded > 60);
}

TEST_CASE("a grid that moves as one has the speed and the direction of its vertices") {
  const Camera camera = make_camera(Projection::orthographic);
  const float pixels = camera.raster_clip().x_scale;
  // 3 pixels to the right, 4 up, which is down in y.
  const glm::vec3 motion = glm::vec3(3, 4, 0) / pixels;
  const auto grid = make_grid(5, 5, {0, 1}, [&](float u, float v, int key) {
    return glm::vec3(u, v, 3) + float(key) * motion;
  });
  const BlurBounds bounds = blur_bounds(*grid, camera, true, true);
  CHECK(bounds.min_speed == Approx(5).epsilon(1e-5));
  CHECK(bounds.direction.x == Approx(0.6).epsilon(1e-5));
  CHECK(bounds.direction.y == Approx(-0.8).epsilon(1e-5));
  CHECK(bounds.half_span_radians < 1e-5f);
  CHECK(bounds.min_coc == 0.0f);  // a pinhole
  CHECK(check_motion(*grid, camera));
}

TEST_CASE("what does not move all over, or is not asked for, has no least speed") {
  const Camera camera = make_camera(Projection::perspective, 1.0, wide_lens);
  const auto moving = [](float u, float v, int key) {
    return glm::vec3(u + 0.2f * float(key), v, 4);
  };
  CHECK(blur_bounds(*make_grid(4, 4, {0, 1}, moving), camera, true, false).min_speed > 0);
  CHECK(blur_bounds(*make_grid(4, 4, {0, 1}, moving), camera, true, false).min_coc == 0);
  CHECK(blur_bounds(*make_grid(4, 4, {0, 1}, moving), camera, false, true).min_speed == 0);
  CHECK(blur_bounds(*make_grid(4, 4, {0, 1}, moving), camera, false, true).min_coc > 0);
  CHECK(blur_bounds(*make_grid(4, 4, {0}, moving), camera, true, false).min_speed == 0);
  // Still throughout, during one of two segments, or at one vertex.
  const auto held = [&](float u, float v, int) { return moving(u, v, 1); };
  const auto late = [&](float u, float v, int key) { return moving(u, v, std::min(key, 1)); };
  const auto hinged = [&](float u, float v, int key) { return moving(u, v, u > 0 ? key : 0); };
  CHECK(blur_bounds(*make_grid(4, 4, {0, 1}, held), camera, true, false).min_speed == 0);
  CHECK(blur_bounds(*make_grid(4, 4, {0, 0.5f, 1}, late), camera, true, false).min_speed == 0);
  CHECK(blur_bounds(*make_grid(4, 4, {0, 1}, hinged), camera, true, false).min_speed == 0);
  // Apart, opposite, or round in a circle.
  const auto apart = [](float u, float v, int key) {
    return glm::vec3(u + (u > 0.5f ? 0.2f : -0.2f) * float(key), v, 4);
  };
  const auto half_turn = [](float u, float v, int key) {
    const float sign = key == 1 ? -1.0f : 1.0f;
    return glm::vec3(sign * (u - 0.45f), sign * (v - 0.55f), 4);
  };
  CHECK(blur_bounds(*make_grid(3, 3, {0, 1}, apart), camera, true, false).min_speed == 0);
  CHECK(blur_bounds(*make_grid(4, 4, {0, 1}, half_turn), camera, true, false).min_speed == 0);
  // Keys at one time: a jump.
  CHECK(blur_bounds(*make_grid(4, 4, {0, 0, 1}, moving), camera, true, false).min_speed == 0);
}

TEST_CASE("a vertex behind the camera plane or not finite leaves nothing bounded") {
  const Camera camera = make_camera(Projection::perspective, 1.0, wide_lens);
  const auto moving = [](float u, float v, int key) {
    return glm::vec3(u + 0.2f * float(key), v, 4);
  };
  REQUIRE(blur_bounds(*make_grid(4, 4, {0, 1}, moving), camera, true, true).min_speed > 0);
  const float inf = std::numeric_limits<float>::infinity();
  for (float bad : {0.0f, -1.0f, -1e-30f, inf, -inf, std::nanf("")}) {
    for (int axis = bad <= 0.0f && std::isfinite(bad) ? 2 : 0; axis < 3; ++axis) {
      for (int key : {0, 1}) {
        for (int vertex : {0, 11, 24}) {
          INFO(bad << " in axis " << axis << " of vertex " << vertex << " at key " << key);
          const auto grid = make_grid(4, 4, {0, 1}, moving);
          grid->P(key, axis)[vertex] = bad;
          const BlurBounds bounds = blur_bounds(*grid, camera, true, true);
          CHECK(bounds.min_speed == 0.0f);
          CHECK(bounds.min_coc == 0.0f);
        }
      }
    }
  }
}

TEST_CASE("bounds of motion hold at extreme coordinates and speeds") {
  const float tiny = 1e-30f, huge = 1e30f;
  for (Projection projection : {Projection::perspective, Projection::orthographic}) {
    const Camera camera = make_camera(projection);
    for (float place : {1e-6f, 1.0f, 1e7f, 1e15f}) {
      for (float step : {tiny, 1e-6f, 1.0f, 1e7f, huge}) {
        INFO((projection == Projection::perspective) << " at " << place << " by " << step);
        // A step is lost in a place that is too large for it; both ways, the oracle knows. Its
        // differences need 14 digits more than the ratio of step and place has.
        const float forward = std::min(step, 1e18f * std::min(place, 1.0f));
        check_motion(*make_grid(3, 3, {0, 1},
                                [&](float u, float v, int key) {
                                  return place * glm::vec3(u, v, 2) +
                                         float(key) * forward * glm::vec3(1 + 0.1f * u, 0.5f, 0.1f);
                                }),
                     camera);
        // Out of the origin, where no step is lost.
        check_motion(*make_grid(3, 3, {0, 1},
                                [&](float u, float v, int key) {
                                  const float moved = float(key) * step;
                                  return glm::vec3(moved * (1 + u), moved * (0.3f + v), place);
                                }),
                     camera);
      }
    }
    // Speeds of both extremes in one grid are bounded by the slow ones, or not at all.
    check_motion(*make_grid(3, 3, {0, 1},
                            [&](float u, float, int key) {
                              return glm::vec3(float(key) * (u > 0.5f ? huge : tiny), 0, 1);
                            }),
                 camera);
    check_motion(*make_grid(3, 3, {0, 1},
                            [&](float, float, int key) {
                              return glm::vec3(0, float(key), key == 0 ? tiny : huge);
                            }),
                 camera);
  }
}

TEST_CASE("velocities that graze the origin are bounded by less than their distance") {
  const Camera camera = make_camera(Projection::orthographic);
  for (float gap : {1.0f, 1e-3f, 1e-7f, 1e-12f, 1e-16f, 0.0f, -1e-7f}) {
    INFO(gap);
    const auto grid = make_grid(3, 3, {0, 1}, [&](float u, float v, int key) {
      return float(key) * glm::vec3(2 * u - 1, gap + v * v, 0) + glm::vec3(0, 0, 1);
    });
    CHECK(check_motion(*grid, camera) == (gap > 1e-14f));
  }
}

TEST_CASE("the least circle of confusion is that of brute force, and 0 across the focal plane") {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> even(0.0f, 1.0f);
  int bounded = 0, unbounded = 0;
  for (int i = 0; i < 400; ++i) {
    const bool flat = i % 2 == 0;
    const Camera camera = make_camera(flat ? Projection::orthographic : Projection::perspective,
                                      1.0 + i % 3, wide_lens);
    const float middle = 2.0f + 6.0f * even(random), range = i % 5 ? 1.5f : 1e-3f;
    const auto grid = make_grid(3, 3, {0, 0.5f, 1}, [&](float u, float v, int) {
      return glm::vec3(u, v, middle + range * (even(random) - 0.5f));
    });
    const BlurBounds bounds = blur_bounds(*grid, camera, true, true);
    CHECK(bounds.min_coc == blur_bounds(*grid, camera, false, true).min_coc);
    const RasterClipMap& map = camera.raster_clip();
    double least = std::numeric_limits<double>::infinity();
    bool in_front = false, behind = false;
    for (int s = 0; s < 2; ++s) {
      for (int k = 0; k < grid->vertex_count(); ++k) {
        for (int step = 0; step <= 8; ++step) {
          const Real z =
              Real(grid->P(s, 2)[k]) * (8 - step) / 8 + Real(grid->P(s + 1, 2)[k]) * step / 8;
          const Real w = map.w_from_z * z + map.w_constant;
          const double x = double((map.coc_x.scale * z + map.coc_x.offset) / w);
          const double y = double((map.coc_y.scale * z + map.coc_y.offset) / w);
          least = std::min({least, std::abs(x), std::abs(y)});
          (x < 0 ? in_front : behind) = true;
        }
      }
    }
    INFO("grid " << i << " about " << middle);
    if (in_front && behind) {
      CHECK(bounds.min_coc == 0.0f);
      ++unbounded;
    } else {
      CHECK(double(bounds.min_coc) <= least);
      CHECK(bounds.min_coc >= least * (1 - 2e-7));
      ++bounded;
    }
  }
  CHECK(bounded > 100);
  CHECK(unbounded > 40);
}
