#pragma once
/// The extremes table, dice: surfaces that move through the eye and the lens.

#include <array>
#include <map>
#include <numbers>
#include <random>

#include "bench/extremes_table.h"
#include "tests/dice/dice_scene.h"

namespace tessera {

using LongVec = glm::vec<3, long double>;

/// A moving parallelogram: linear in u, v and time, so that the dice of it is the surface itself.
struct MovingPlane {
  std::array<glm::dvec3, 2> corner, u, v;  ///< at both keys

  LongVec at(double a, double b, double t) const {
    const auto key = [&](size_t k) { return corner[k] + a * u[k] + b * v[k]; };
    return LongVec(glm::mix(key(0), key(1), t));
  }
};

/// Points of planes through the eye, seen at any time through any place of the lens: the bucket
/// where each is seen must have been given the grid that it lies on.
inline WorstError missed_points(const MovingPlane& plane, std::mt19937& random, int count) {
  test::DiceScene s;
  s.scene.camera.near_clip = 0.05;
  s.scene.camera.lens = CameraSettings::ThinLens{1, 0.2, 1.5};
  s.settings.dicing_rate = 64;  // near the eye there is no end to what could be cut
  s.scene.camera.shutter_close = 1;
  PatchMesh mesh = test::bicubic_mesh(2, 2);
  mesh.bicubic = false;
  Geometry g = test::geometry(mesh);
  g.key_times = {0, 1};
  for (const double t : {0.0, 1.0})
    g.P_object.push_back(
        {plane.at(0, 0, t), plane.at(1, 0, t), plane.at(0, 1, t), plane.at(1, 1, t)});
  s.add(std::move(g));
  const Camera camera(s.scene.camera);
  const auto source = s.source(camera);
  std::map<std::pair<int, int>, std::vector<std::shared_ptr<const Grid>>> buckets;
  std::uniform_real_distribution<double> unit(0, 1);
  WorstError error;
  for (int k = 0; k < count; ++k) {
    const double a = unit(random), b = unit(random), t = unit(random);
    const LongVec P = plane.at(a, b, t);
    const double radius = std::sqrt(unit(random)), turn = 2 * M_PI * unit(random);
    if (!(P.z > 0.05L)) continue;
    // Where the line from P through the lens crosses the plane of focus, as the pinhole sees it.
    const long double pixels = 60 / std::tan(std::numbers::pi_v<long double> / 6);
    const auto seen = [&](long double p, long double lens) {
      return pixels * (lens + (p - lens) * 1.5L / P.z) / 1.5L;
    };
    const long double x = 80 + seen(P.x, 0.1L * radius * std::cos(turn));
    const long double y = 60 - seen(P.y, 0.1L * radius * std::sin(turn));
    const auto inside = [&](long double at, int size) {
      const long double place = std::fmod(at, (long double)(s.settings.bucket_size));
      return at > 0 && at < size && place > 0.02L && place < s.settings.bucket_size - 0.02L;
    };
    if (!inside(x, 160) || !inside(y, 120)) continue;
    const std::pair bucket(int(x) / s.settings.bucket_size, int(y) / s.settings.bucket_size);
    if (!buckets.contains(bucket))
      buckets[bucket] = source->grids_of_bucket(bucket.first, bucket.second);
    const auto holds = [&](const std::shared_ptr<const Grid>& grid) {
      const auto within = [&](const float* values, double at) {
        const auto [low, high] = std::minmax_element(values, values + grid->vertex_count());
        return at >= double(*low) - 1e-6 && at <= double(*high) + 1e-6;
      };
      return within(grid->uv.data(), a) && within(grid->uv.data() + grid->stride(), b);
    };
    error.see(std::ranges::any_of(buckets[bucket], holds) ? 0.0 : 1.0);
  }
  return error;
}

inline void add_eye_extremes(ExtremesTable& table) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto vector = [&](double size) {
    const double x = unit(random), y = unit(random), z = unit(random);
    return size * glm::dvec3(x, y, z);
  };
  for (const double size : {1.0, 10.0}) {
    WorstError all;
    for (int k = 0; k < table.scaled(24, 4); ++k) {
      MovingPlane plane;
      for (size_t key = 0; key < 2; ++key) {
        plane.u[key] = vector(size), plane.v[key] = vector(size);
        // The eye is near the middle, or on it.
        plane.corner[key] =
            (k % 4 ? vector(0.5) : glm::dvec3(0.0)) - 0.5 * (plane.u[key] + plane.v[key]);
      }
      const WorstError error = missed_points(plane, random, 20000);
      all.worst = std::max(all.worst, error.worst), all.count += error.count;
    }
    table.add({"dice", fmt::format("moving planes of {:g} through eye and lens", size),
               "points seen from random places", all, "missed", 0});
  }
}

}  // namespace tessera
