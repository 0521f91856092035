// What is out of the frame at the motion keys and passes through it in between has to be diced as
// finely as when it is in view.

#include <array>
#include <cmath>
#include <random>

#include <catch2/catch.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "dice/passage.h"
#include "tests/dice/dice_scene.h"

namespace tessera::test {
namespace {

constexpr int width = 64, height = 48;
// fov 60 degrees over the height: a unit at distance 1 spans this many pixels.
const double focal = 0.5 * height / std::tan(3.14159265358979 / 6);

using Place = glm::vec<3, long double>;

// Pixels of the part of a segment that is in the frame, whatever its ends: cut at the planes
// through the eye and the sides of the frame, then projected.
double length_in_frame(const Place& a, const Place& b) {
  const std::array<Place, 5> planes{Place(focal, 0, 0.5L * width), Place(-focal, 0, 0.5L * width),
                                    Place(0, focal, 0.5L * height), Place(0, -focal, 0.5L * height),
                                    Place(0, 0, 1)};
  long double first = 0, last = 1;
  for (size_t k = 0; k < planes.size(); ++k) {
    const long double least = k == 4 ? 0.01L : 0.0L;
    const long double at_a = glm::dot(planes[k], a) - least, at_b = glm::dot(planes[k], b) - least;
    if (at_a < 0 && at_b < 0) return 0;
    const long double crossing = at_a / (at_a - at_b);
    if (at_a < 0) first = std::max(first, crossing);
    if (at_b < 0) last = std::min(last, crossing);
  }
  if (!(first < last)) return 0;
  const Place p = a + first * (b - a), q = a + last * (b - a);
  return double(focal * std::hypot(p.x / p.z - q.x / q.z, p.y / p.z - q.y / q.z));
}

glm::dmat4 shift(double x, double y, double z) {
  return glm::translate(glm::dmat4(1), glm::dvec3(x, y, z));
}

glm::dmat4 pan(double degrees) {
  return glm::rotate(glm::dmat4(1), glm::radians(degrees), glm::dvec3(0, 1, 0));
}

Geometry ball() { return geometry(Quadric{Quadric::Kind::sphere, {{1, -1, 1, 360}}}); }

Geometry wall() {
  PatchMesh mesh;
  mesh.u_vertices = mesh.v_vertices = 2;
  return geometry(mesh, {{-1, -1, 0}, {1, -1, 0}, {-1, 1, 0}, {1, 1, 0}});
}

// A surface placed by matrices at even times; in between every entry is linear, so points are.
struct Moving {
  std::string name;
  Geometry geometry;
  std::vector<glm::dmat4> keys;

  glm::dmat4 at(double t) const {
    const double place = t * double(keys.size() - 1);
    const size_t key = std::min(size_t(place), keys.size() - 2);
    const double share = place - double(key);
    return keys[key] * (1 - share) + keys[key + 1] * share;
  }
};

struct PlacedScene : DiceScene {
  // `step`: pixels between vertices.
  PlacedScene(const Geometry& shape, const std::vector<glm::dmat4>& keys, float step)
      : DiceScene(width, height) {
    scene.camera.shutter_close = 1;
    settings.dicing_rate = step * step;
    Attributes attributes;
    attributes.motion_factor = 0;
    Surface& surface = add(shape, keys.front(), attributes);
    std::vector<float> times;
    for (size_t k = 0; k < keys.size(); ++k) times.push_back(float(k) / float(keys.size() - 1));
    if (keys.size() > 1) surface.world_from_object = MovingTransform(times, keys);
  }
};

// A vertex at time t; keys are at even times.
Place vertex_at(const Grid& g, int k, double t) {
  const double place = t * double(g.key_count() - 1);
  const int key = std::max(0, std::min(int(place), g.key_count() - 2));
  const int next = std::min(key + 1, g.key_count() - 1);
  const long double share = place - key;
  Place p;
  for (int axis = 0; axis < 3; ++axis)
    p[axis] = (1 - share) * g.P(key, axis)[k] + share * g.P(next, axis)[k];
  return p;
}

// Parts in the frame of the sides of micropolygons.
struct Sides {
  double longest = 0;
  int seen = 0;

  void see(const Grids& grids, double t) {
    for (const auto& g : grids) {
      const int row = g->u_count + 1;
      const auto side = [&](int k, int l) {
        const double length = length_in_frame(vertex_at(*g, k, t), vertex_at(*g, l, t));
        longest = std::max(longest, length), seen += length > 0;
      };
      for (int k = 0; k < g->vertex_count(); ++k) {
        if (k % row < g->u_count) side(k, k + 1);
        if (k / row < g->v_count) side(k, k + row);
      }
    }
  }
};

// Of a surface that is in view for `share` of the shutter, about its middle.
void check_rates(const Moving& m, double share, float step) {
  INFO(m.name);
  PlacedScene moving(m.geometry, m.keys, step);
  DiceCounters counters;
  const Grids grids = moving.all_grids(&counters);
  uint64_t most = 0;
  Sides of_moving, of_still;
  for (int k = 0; k <= 32; ++k) {
    const double t = 0.5 + share * (k / 32.0 - 0.5);
    PlacedScene still(m.geometry, {m.at(t)}, step);
    DiceCounters still_counters;
    const Grids still_grids = still.all_grids(&still_counters);
    most = std::max(most, still_counters.micropolygons);
    if (k % 2 != 0) continue;
    of_still.see(still_grids, 0);
    of_moving.see(grids, t);
  }
  INFO("micropolygons " << counters.micropolygons << ", still " << most << "; longest side "
                        << of_moving.longest << ", still " << of_still.longest << "; seen "
                        << of_moving.seen << ", still " << of_still.seen);
  CHECK(most > 100);
  CHECK(counters.micropolygons >= most);
  CHECK(of_moving.seen > 0.5 * of_still.seen);
  // As where nothing moves: sampled lengths run a little short, and vertices on the boundary move.
  CHECK(of_moving.longest < std::max(2.2 * double(step), 1.1 * of_still.longest));
}

TEST_CASE("what passes the frame between keys is diced as when it is in view", "[dice][passage]") {
  const glm::dmat4 wide = glm::scale(shift(0, 0, 4), glm::dvec3(900, 9, 1));
  for (const double x : {500.0, 2000.0, 5000.0}) {
    check_rates({fmt::format("wide ball to {}", x),
                 ball(),
                 {shift(-x, 0, 0) * wide, shift(x, 0, 0) * wide}},
                std::min(1.0, 900 / x), 24);
  }
  // The last by 1e5 pixels to either side.
  for (const double x : {20.0, 500.0, 2000.0, 5000.0, 1e5 / focal * 5}) {
    check_rates({fmt::format("ball to {}", x), ball(), {shift(-x, 0, 5), shift(x, 0, 5)}}, 4 / x,
                2);
    check_rates({fmt::format("ball down from {}", x), ball(), {shift(0, x, 5), shift(0, -x, 5)}},
                4 / x, 2);
  }
}

TEST_CASE("a wall with all its samples beside the frame is diced when it passes",
          "[dice][passage]") {
  // 4 or 8 pieces of 50 or 100 units: their ends are above and below the frame all the time.
  const glm::dmat4 high = glm::scale(shift(0, 25, 6), glm::dvec3(0.5, 200, 1));
  check_rates({"high wall", wall(), {shift(-300, 0, 0) * high, shift(300, 0, 0) * high}}, 0.02, 2);
}

TEST_CASE("whip pans over few and many keys are diced as when in view", "[dice][passage]") {
  for (const int keys : {2, 3, 4, 8}) {
    for (const double degrees : {50.0, 70.0}) {
      Moving m{fmt::format("pan of {} degrees with {} keys", 2 * degrees, keys), ball(), {}};
      for (int k = 0; k < keys; ++k)
        m.keys.push_back(pan(degrees * (2.0 * k / (keys - 1) - 1)) * shift(0, 0, 7));
      check_rates(m, 1, 2);
    }
  }
}

TEST_CASE("what flies past the eye is diced as when in view", "[dice][passage]") {
  check_rates({"past the eye", ball(), {shift(-30, 2, 60), shift(30, 2, -30)}}, 1, 2);
  check_rates({"from behind", ball(), {shift(-10, 0, -20), shift(10, 0, 40)}}, 1, 2);
}

MovingSegment random_segment(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto point = [&](double reach) {
    const double x = unit(random), y = unit(random), z = unit(random);
    return reach * glm::dvec3(x, y, z);
  };
  const double away = std::pow(10, 2 * unit(random));
  const glm::dvec3 from = point(away), to = point(away);
  MovingSegment s;
  s.a0 = from, s.b0 = from + point(size), s.a1 = to, s.b1 = to + point(size);
  return s;
}

Place between(const glm::vec3& from, const glm::vec3& to, long double t) {
  return (1 - t) * Place(from) + t * Place(to);
}

// The most of `length(a, b)` at many times, over what is found.
template <class LengthOf>
std::vector<double> shortfalls(const RasterProjection& projection, const LengthOf& length_of) {
  std::mt19937 random(1);
  std::vector<double> ratios;
  for (int trial = 0; trial < 4000; ++trial) {
    const MovingSegment s = random_segment(random, trial % 2 ? 0.1 : 10);
    double most = 0;
    for (int k = 0; k <= 300; ++k) {
      const long double t = k / 300.0L;
      most = std::max(most, double(length_of(between(s.a0, s.a1, t), between(s.b0, s.b1, t))));
    }
    const double found = longest_length(projection, s);
    REQUIRE(std::isfinite(found));
    if (most > 0) ratios.push_back(most / found);
  }
  std::sort(ratios.begin(), ratios.end());
  return ratios;
}

// Ends of a random segment go their own ways, so it may be longest at any time; those of neighbours
// on a surface hardly do.
void check_shortfalls(const std::vector<double>& ratios) {
  REQUIRE(ratios.size() > 1000);
  INFO("of " << ratios.size() << ": 90% " << ratios[ratios.size() * 9 / 10] << " 99% "
             << ratios[ratios.size() * 99 / 100] << " worst " << ratios.back());
  CHECK(ratios[ratios.size() * 9 / 10] < 1.02);
  CHECK(ratios[ratios.size() * 99 / 100] < 1.25);
  CHECK(ratios.back() < 3);
}

TEST_CASE("the length of a moving segment is the most at many times", "[dice][passage]") {
  DiceScene scene(width, height);
  const RasterProjection projection(Camera(scene.scene.camera), scene.settings.crop);
  check_shortfalls(shortfalls(projection, length_in_frame));
}

TEST_CASE("the length of a moving segment from all of an open lens", "[dice][passage]") {
  DiceScene scene(width, height);
  const double radius = 0.2, distance = 3;
  scene.scene.camera.lens = CameraSettings::ThinLens{1, 2 * radius, distance};
  const RasterProjection projection(Camera(scene.scene.camera), scene.settings.crop);
  check_shortfalls(shortfalls(projection, [&](const Place& a, const Place& b) {
    double most = 0;
    // As from the lens centre, of what is moved aside by what the focal plane does not hold still.
    for (const auto& [u, v] : {std::pair{0, 0}, {1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
      const auto moved = [&](const Place& p) {
        const long double by = radius * (1 - p.z / distance);
        return Place(p.x + by * u, p.y + by * v, p.z);
      };
      most = std::max(most, length_in_frame(moved(a), moved(b)));
    }
    return most;
  }));
}

TEST_CASE("turned to the eye, the length of what passes it is that where it is nearest",
          "[dice][passage]") {
  DiceScene scene(width, height);
  RasterProjection projection(Camera(scene.scene.camera), scene.settings.crop);
  const long double least = 0.05L;
  projection.turn_to_eye(float(least));
  check_shortfalls(shortfalls(projection, [&](const Place& a, const Place& b) {
    const long double nearest =
        std::max(least, std::min({glm::length(a), glm::length(b), glm::length((a + b) / 2.0L)}));
    return std::min(1e9L, 0.5L * focal * glm::length(b - a) / nearest);
  }));
}

TEST_CASE("lengths of what stays where it is, or is no number, are those of the keys",
          "[dice][passage]") {
  DiceScene scene(width, height);
  const float inf = std::numeric_limits<float>::infinity(), nan = std::nanf("");
  for (const bool turned : {false, true}) {
    RasterProjection projection(Camera(scene.scene.camera), scene.settings.crop);
    if (turned) projection.turn_to_eye(0.01f);
    std::mt19937 random(3);
    for (int trial = 0; trial < 1000; ++trial) {
      MovingSegment s = random_segment(random, 1);
      s.a1 = s.a0, s.b1 = s.b0;
      const float still = projection.segment_length(s.a0, s.b0);
      CHECK(longest_length(projection, s) == still);
    }
    for (const float bad : {inf, -inf, nan, 3e38f, -3e38f}) {
      for (int axis = 0; axis < 3; ++axis) {
        MovingSegment s = random_segment(random, 1);
        s.b1[axis] = bad;
        CHECK(longest_length(projection, s) >= 0);
        CHECK(std::isfinite(longest_length(projection, s)));
        s.b0 = s.a0 = s.a1 = s.b1;
        CHECK(std::isfinite(longest_length(projection, s)));
      }
    }
  }
}

TEST_CASE("what stays in the frame or beside it is measured at its keys alone", "[dice][passage]") {
  DiceScene scene(width, height);
  const auto matters = [&](const std::vector<glm::vec3>& keys) {
    const RasterProjection projection(Camera(scene.scene.camera), scene.settings.crop);
    Passage passage(projection);
    for (const glm::vec3& P : keys) {
      const std::array<glm::vec3, 2> samples{P, P + glm::vec3(0, 0.1f, 0)};
      passage.add_key(samples);
    }
    return passage.matters();
  };
  CHECK_FALSE(matters({{-50, 0, 5}}));
  CHECK_FALSE(matters({{-1, 0, 5}, {1, 0, 5}}));
  CHECK_FALSE(matters({{-50, 0, 5}, {-20, 8, 5}}));
  CHECK_FALSE(matters({{-1, 0, -5}, {1, 0, -3}}));
  CHECK(matters({{-50, 0, 5}, {50, 0, 5}}));
  CHECK(matters({{0, 0, 5}, {50, 0, 1}}));
  CHECK(matters({{-50, 0, 5}, {-60, 0, 5}, {0, 80, 5}}));
  CHECK_FALSE(matters({{-50, 0, 5}, {50, 0, 5}, {60, 0, 5}}));
  scene.scene.camera.projection = Projection::orthographic;
  CHECK_FALSE(matters({{-50, 0, 5}, {50, 0, 5}}));
}

}  // namespace
}  // namespace tessera::test
