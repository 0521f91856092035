// What a GridSource promises: rates, bounds, culling, sharing, memory.

#include <cmath>
#include <cstring>
#include <random>
#include <set>
#include <thread>

#include <catch2/catch.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "tests/dice/dice_scene.h"

namespace tessera::test {
namespace {

const glm::dmat4 away = glm::translate(glm::dmat4(1), glm::dvec3(0, 0, 6));

glm::vec3 P_at(const Grid& g, int k, double t) {
  size_t key = 0;
  while (key + 2 < g.key_times.size() && g.key_times[key + 1] < t) ++key;
  if (g.key_times.size() == 1) return {g.P(0, 0)[k], g.P(0, 1)[k], g.P(0, 2)[k]};
  const float w = (float(t) - g.key_times[key]) / (g.key_times[key + 1] - g.key_times[key]);
  glm::vec3 p;
  for (int axis = 0; axis < 3; ++axis) {
    p[axis] = (1 - w) * g.P(int(key), axis)[k] + w * g.P(int(key) + 1, axis)[k];
  }
  return p;
}

TEST_CASE("micropolygons have the area ShadingRate asks for", "[dice][rate]") {
  const std::vector<Geometry> shapes{
      geometry(cube_cage(), cube_points()),
      geometry(Quadric{Quadric::Kind::torus, {{1, .4, 0, 360, 360}}})};
  for (const Geometry& shape : shapes) {
    for (const float rate : {0.5f, 1.0f, 4.0f}) {
      INFO("rate " << rate);
      DiceScene s(200, 200);
      Attributes attributes;
      attributes.shading_rate = rate;
      s.add(shape, glm::rotate(away, 0.6, glm::dvec3(1, 1, 0)), attributes);
      const Camera camera(s.scene.camera);
      double longest = 0, total = 0;
      size_t count = 0;
      for (const auto& g : s.all_grids()) {
        CHECK(g->u_count <= 32);
        CHECK(g->v_count <= 32);
        const auto raster = [&](int k) {
          const glm::vec3 c = camera.raster_clip_from_camera(P_at(*g, k, 0));
          return glm::vec2(c.x, c.y) / c.z;
        };
        for (int j = 0; j < g->v_count; ++j) {
          for (int i = 0; i < g->u_count; ++i) {
            const int a = j * (g->u_count + 1) + i;
            const glm::vec2 A = raster(a), B = raster(a + 1), C = raster(a + g->u_count + 1);
            longest = std::max({longest, double(glm::distance(A, B)), double(glm::distance(A, C))});
            total += std::abs((B - A).x * (C - A).y - (B - A).y * (C - A).x);
            ++count;
          }
        }
      }
      // Sampled lengths run a little short, and boundary vertices move by up to half a step.
      CHECK(longest < 2.2 * std::sqrt(rate));
      CHECK(total / double(count) > 0.15 * rate);
      CHECK(total / double(count) < 1.2 * rate);
    }
  }
}

TEST_CASE("a dicing rate goes before ShadingRate, and the frame's before a surface's",
          "[dice][rate]") {
  const auto micropolygons = [](float shading_rate, std::optional<float> surface_rate,
                                std::optional<float> frame_rate) {
    DiceScene s(200, 200);
    Attributes attributes;
    attributes.shading_rate = shading_rate;
    if (surface_rate) attributes.user["dice:rate"].numbers = {*surface_rate};
    s.settings.dicing_rate = frame_rate;
    s.add(geometry(cube_cage(), cube_points()), away, attributes);
    DiceCounters counters;
    s.all_grids(&counters);
    return counters.micropolygons;
  };
  const uint64_t of_4 = micropolygons(4, {}, {}), of_1 = micropolygons(1, {}, {});
  CHECK(double(of_1) > 3 * double(of_4));
  CHECK(micropolygons(1, 4.0f, {}) == of_4);
  CHECK(micropolygons(4, 1.0f, {}) == of_1);
  CHECK(micropolygons(1, {}, 4.0f) == of_4);
  CHECK(micropolygons(1, 1.0f, 4.0f) == of_4);
}

TEST_CASE("raster bounds hold every point through every part of the lens and shutter",
          "[dice][bounds]") {
  for (const bool perspective : {true, false}) {
    DiceScene s(200, 200);
    CameraSettings& c = s.scene.camera;
    c.lens = CameraSettings::ThinLens{2.0, 0.8, 5.0};
    c.shutter_close = 1;
    if (!perspective) c.projection = Projection::orthographic;
    Surface& surface = s.add(geometry(cube_cage(), cube_points()));
    surface.world_from_object = MovingTransform(
        {0.0f, 1.0f},
        {glm::scale(away, glm::dvec3(0.6)),
         glm::translate(glm::rotate(glm::scale(away, glm::dvec3(0.6)), 1.0, glm::dvec3(0, 1, 0.3)),
                        glm::dvec3(1, 0.3, -2))});
    const Camera camera(c);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(0, 1);
    const Grids grids = s.all_grids();
    REQUIRE(grids.size() > 4);
    int checked = 0, near_bound = 0;
    for (const auto& g : grids) {
      const RasterBounds& b = g->raster_bounds;
      REQUIRE(std::isfinite(b.x_min));
      for (int trial = 0; trial < 300; ++trial) {
        const int k = int(uniform(random) * g->vertex_count());
        const glm::vec3 p = P_at(*g, k, uniform(random));
        const glm::vec2 lens =
            camera.lens_profile().sample(float(uniform(random)), float(uniform(random)));
        const glm::vec3 clip = camera.raster_clip_from_camera(p);
        const RasterClipMap& map = camera.raster_clip();
        const float x = (clip.x + lens.x * map.coc_x(p.z)) / clip.z;
        const float y = (clip.y + lens.y * map.coc_y(p.z)) / clip.z;
        const float slack = 1e-4f * (std::abs(x) + std::abs(y) + 1);
        REQUIRE(x >= b.x_min - slack);
        REQUIRE(x <= b.x_max + slack);
        REQUIRE(y >= b.y_min - slack);
        REQUIRE(y <= b.y_max + slack);
        CHECK(p.z >= g->z_min - 1e-4f);
        CHECK(p.z <= g->z_max + 1e-4f);
        ++checked;
        near_bound += x < b.x_min + 0.2f * (b.x_max - b.x_min);
      }
    }
    CHECK(near_bound > checked / 100);
  }
}

TEST_CASE("every bucket gets every grid that touches it", "[dice][buckets]") {
  // Chunks are found by bounds made before dicing: they must not miss a grid.
  DiceScene s(150, 130);
  s.settings.bucket_size = 16;
  s.settings.crop = {7, 3, 141, 128};
  s.add(
      geometry(torus_cage(30, 20), torus_points(30, 20)),
      glm::rotate(glm::translate(glm::dmat4(1), glm::dvec3(0, 0, 2.5)), 0.8, glm::dvec3(1, 0, 0)));
  s.add(geometry(cube_cage(), cube_points()), away);
  s.add(geometry(Quadric{Quadric::Kind::hyperboloid, {{1, 0, -1, 0.6, 0.8, 1, 360}}}), away);
  const Grids all = s.all_grids();
  const Camera camera(s.scene.camera);
  const auto source = s.source(camera);
  for (int j = 0; j < s.rows(); ++j) {
    for (int i = 0; i < s.columns(); ++i) {
      const PixelRect pixels =
          PixelRect{7 + 16 * i, 3 + 16 * j, 23 + 16 * i, 19 + 16 * j}.intersect(s.settings.crop);
      std::set<GridId> expected, found;
      for (const auto& g : all) {
        if (g->raster_bounds.overlaps(pixels)) expected.insert(g->id);
      }
      float z = -1;
      for (const auto& g : source->grids_of_bucket(i, j)) {
        found.insert(g->id);
        CHECK(g->z_min >= z);
        z = g->z_min;
      }
      CHECK(found == expected);
      source->finish_bucket(i, j);
    }
  }
  CHECK(source->grids_of_bucket(99, 0).empty());
}

bool same(const Grid& a, const Grid& b) {
  const auto equal = [](const AlignedVector<float>& x, const AlignedVector<float>& y) {
    return x.size() == y.size() && std::memcmp(x.data(), y.data(), x.size() * sizeof(float)) == 0;
  };
  return a.id == b.id && a.u_count == b.u_count && a.v_count == b.v_count &&
         equal(a.P_camera, b.P_camera) && equal(a.N_camera, b.N_camera) && equal(a.uv, b.uv) &&
         equal(a.st, b.st);
}

struct BusyScene : DiceScene {
  BusyScene() : DiceScene(200, 160) {
    settings.bucket_size = 16;
    for (int k = 0; k < 5; ++k) {
      add(geometry(cube_cage(), cube_points()),
          glm::rotate(glm::translate(glm::dmat4(1), glm::dvec3(k - 2, 0.3 * k - 0.6, 4 + k)),
                      0.5 * k, glm::dvec3(1, 2, 0)));
    }
  }
};

TEST_CASE("grids dropped for memory come back the same", "[dice][memory]") {
  BusyScene roomy, tight;
  tight.settings.memory_budget_bytes = 100000;
  const Camera camera(roomy.scene.camera);
  const auto a = roomy.source(camera), b = tight.source(camera);
  for (int j = 0; j < roomy.rows(); ++j) {
    for (int i = 0; i < roomy.columns(); ++i) {
      const auto left = a->grids_of_bucket(i, j), right = b->grids_of_bucket(i, j);
      REQUIRE(left.size() == right.size());
      for (size_t k = 0; k < left.size(); ++k) REQUIRE(same(*left[k], *right[k]));
      a->finish_bucket(i, j);
      b->finish_bucket(i, j);
    }
  }
  CHECK(a->counters().grids_diced_again == 0);
  CHECK(b->counters().grids_diced_again > 0);
  CHECK(a->counters().grids == b->counters().grids);
  CHECK(b->peak_bytes() < a->peak_bytes());
}

TEST_CASE("grids are freed after their last bucket", "[dice][memory]") {
  BusyScene s;
  const Camera camera(s.scene.camera);
  const auto source = s.source(camera);
  std::vector<std::weak_ptr<const Grid>> watched;
  for (int j = 0; j < s.rows(); ++j) {
    for (int i = 0; i < s.columns(); ++i) {
      for (const auto& g : source->grids_of_bucket(i, j)) watched.push_back(g);
      source->finish_bucket(i, j);
    }
  }
  REQUIRE(watched.size() > 10);
  for (const auto& g : watched) CHECK(g.expired());
}

TEST_CASE("bucket order and threads change nothing", "[dice][threads]") {
  BusyScene s;
  s.settings.memory_budget_bytes = 300000;
  const Camera camera(s.scene.camera);
  const auto source = s.source(camera);
  std::atomic<int> next{0}, different{0};
  const int buckets = s.columns() * s.rows();
  BusyScene other;
  const auto expected = other.source(camera);
  const auto work = [&] {
    for (int k; (k = next++) < buckets;) {
      const int bucket = buckets - 1 - k, i = bucket % s.columns(), j = bucket / s.columns();
      const auto mine = source->grids_of_bucket(i, j), theirs = expected->grids_of_bucket(i, j);
      if (mine.size() != theirs.size()) {
        ++different;
        continue;
      }
      for (size_t g = 0; g < mine.size(); ++g) different += !same(*mine[g], *theirs[g]);
      source->finish_bucket(i, j);
    }
  };
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) threads.emplace_back(work);
  for (std::thread& t : threads) t.join();
  CHECK(different == 0);
}

TEST_CASE("a surface through the camera gives a bounded number of grids", "[dice][eye]") {
  for (const bool lens : {false, true}) {
    for (const double height : {-0.5, -1e-3, 0.0, 0.3}) {
      INFO("height " << height << " lens " << lens);
      DiceScene s(160, 120);
      if (lens) s.scene.camera.lens = CameraSettings::ThinLens{4.0, 0.1, 3.0};
      PatchMesh mesh;
      // A floor (or a wall edge-on) from far behind the camera to far in front.
      s.add(geometry(mesh, {{-500, float(height), -500},
                            {500, float(height), -500},
                            {-500, float(height), 1000},
                            {500, float(height), 1000}}));
      s.add(geometry(Quadric{Quadric::Kind::sphere, {{2.0, -2.0, 2.0, 360}}}));
      DiceCounters counters;
      const Grids grids = s.all_grids(&counters);
      CHECK(grids.size() < 4000);
      CHECK(counters.splits < 40000);
      for (const auto& g : grids) {
        for (int k = 0; k < g->vertex_count(); ++k) REQUIRE(std::isfinite(g->P(0, 2)[k]));
      }
      if (height == -0.5 && !lens) {
        // The floor is seen up to the horizon: a point well in front is covered by a grid there.
        bool found = false;
        for (const auto& g : grids) {
          const RasterBounds& b = g->raster_bounds;
          found |= g->id.surface == 0 && b.x_min < 85 && b.x_max > 85 && b.y_min < 100 &&
                   b.y_max > 100 && b.x_max - b.x_min < 80;
        }
        CHECK(found);
      }
    }
  }
}

TEST_CASE("what the camera cannot see is not diced", "[dice][cull]") {
  DiceScene s;
  const Geometry ball = geometry(Quadric{Quadric::Kind::sphere, {{1, -1, 1, 360}}});
  for (const glm::dvec3 at : {glm::dvec3(50, 0, 6), glm::dvec3(0, -50, 6), glm::dvec3(0, 0, -6)}) {
    s.add(ball, glm::translate(glm::dmat4(1), at));
  }
  s.scene.camera.far_clip = 20;
  s.add(ball, glm::translate(glm::dmat4(1), glm::dvec3(0, 0, 40)));
  DiceCounters counters;
  CHECK(s.all_grids(&counters).empty());
  CHECK(counters.culled == 4);
  CHECK(counters.grids == 0);
  // A displacement bound could bring the first into view.
  DiceScene bumpy;
  class Flat final : public Displacer {
    void displace(const Grid&, std::span<float>) const override {}
  } flat;
  bumpy.settings.displacer = &flat;
  Attributes attributes;
  attributes.displacement.emplace();
  attributes.displacement_bound = 60;
  bumpy.add(ball, glm::translate(glm::dmat4(1), glm::dvec3(50, 0, 6)), attributes);
  bumpy.all_grids(&counters);
  CHECK(counters.culled == 0);
  CHECK(counters.grids > 0);
}

TEST_CASE("bad geometry is dropped and counted, the rest is diced", "[dice][hostile]") {
  DiceScene s;
  std::vector<glm::vec3> points = cube_points();
  points[3].y = std::nanf("");
  s.add(geometry(cube_cage(), points), away);
  points[3].y = std::numeric_limits<float>::infinity();
  s.add(geometry(cube_cage(), points), away);
  s.add(geometry(Quadric{Quadric::Kind::paraboloid, {{1, 0, 0, 360}}}), away);
  s.add(geometry(Quadric{Quadric::Kind::sphere, {{1e-7, -1e-7, 1e-7, 360}}}), away);
  // All points in one place, and all on a line.
  s.add(geometry(bicubic_mesh(), std::vector<glm::vec3>(16, glm::vec3(0))), away);
  std::vector<glm::vec3> line;
  for (int k = 0; k < 16; ++k) line.emplace_back(0.1f * float(k), 0, 0);
  s.add(geometry(bicubic_mesh(), line), away);
  // A mesh OpenSubdiv refuses: an index used by no face is fine, a face of two vertices is not.
  SubdivisionMesh bad;
  bad.face_vertex_counts = {2};
  bad.face_vertices = {0, 1};
  s.add(geometry(bad, cube_points()), away);
  s.add(geometry(Quadric{Quadric::Kind::sphere, {{1, -1, 1, 360}}}), away);
  DiceCounters counters;
  const Grids grids = s.all_grids(&counters);
  CHECK(counters.dropped_nonfinite > 0);
  bool sphere = false;
  for (const auto& g : grids) {
    sphere |= g->id.surface == 7;
    for (int k = 0; k < g->vertex_count(); ++k) {
      REQUIRE(std::isfinite(g->P(0, 0)[k] + g->P(0, 1)[k] + g->P(0, 2)[k]));
      const float squared =
          g->N(0)[k] * g->N(0)[k] + g->N(1)[k] * g->N(1)[k] + g->N(2)[k] * g->N(2)[k];
      REQUIRE(squared == Approx(1).margin(1e-3));
    }
  }
  CHECK(sphere);
}

TEST_CASE("displacement moves along the normal, by no more than its bound",
          "[dice][displacement]") {
  class Grow final : public Displacer {
   public:
    explicit Grow(float by) : by_(by) {}
    void displace(const Grid& grid, std::span<float> distance) const override {
      std::fill_n(distance.begin(), grid.vertex_count(), by_);
    }

   private:
    float by_;
  };
  for (const float bound : {0.5f, 0.1f}) {
    const Grow grow(0.3f);
    DiceScene s;
    s.settings.displacer = &grow;
    Attributes attributes;
    attributes.displacement.emplace();
    attributes.displacement_bound = bound;
    s.add(geometry(Quadric{Quadric::Kind::sphere, {{1, -1, 1, 360}}}), away, attributes);
    const float radius = 1 + std::min(bound, 0.3f);
    for (const auto& g : s.all_grids()) {
      for (int k = 0; k < g->vertex_count(); ++k) {
        const glm::vec3 p = glm::vec3(g->P(0, 0)[k], g->P(0, 1)[k], g->P(0, 2)[k] - 6);
        // The poles' normals are limits from a little beside them.
        CHECK(glm::length(p) == Approx(radius).margin(2e-5));
        CHECK(glm::dot(glm::vec3(g->N(0)[k], g->N(1)[k], g->N(2)[k]), p) > 0.97f * radius);
      }
    }
    CHECK(s.diagnostics.lines().size() == (bound < 0.3f ? 1u : 0u));
  }
}

}  // namespace
}  // namespace tessera::test
