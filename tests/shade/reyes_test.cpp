#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <thread>

#include "shade/surface_shading.h"
#include "tests/shade/fixtures.h"

using namespace tessera;
using namespace tessera::test;

namespace {

/// A bucket whose sample k sees triangle k % (all triangles) of grid k % grids.
TestBucket make_bucket(std::vector<std::shared_ptr<const Grid>> grids, int samples, int first) {
  TestBucket bucket(samples);
  bucket.grids = std::move(grids);
  for (int k = first; k < first + samples; ++k) {
    const auto grid = uint32_t(k) % uint32_t(bucket.grids.size());
    const auto triangles = uint32_t(2 * bucket.grids[grid]->micropolygon_count());
    bucket.add(grid, uint32_t(k * 7) % triangles, 0.25f, 0.5f, 1.0f);
    bucket.finish_sample();
  }
  return bucket;
}

}  // namespace

TEST_CASE("unknown shading modes list the choices, and reyes takes no arguments") {
  TestScene test;
  const auto bindings = test.bind();
  CHECK_THROWS_WITH(make_shading("rays", {bindings}), Catch::Contains("reyes"));
  CHECK_THROWS_AS(make_shading("reyes:7", {bindings}), Error);
  CHECK(make_shading("reyes", {bindings}) != nullptr);
}

TEST_CASE("fragments interpolate the vertex colours of their triangle") {
  TestScene test;
  const auto grid = make_square(test.add_surface("constant"), 2, 3.0f);
  // A colour linear in (u, v) is reproduced exactly by linear interpolation on both triangles.
  const auto Cs = add_primvar(*grid, "Cs", ValueType::color, [](float u, float v) {
    return std::vector<float>{u, v, 2.0f * u - v};
  });
  const auto shading = make_shading("reyes", {test.bind()});
  TestBucket bucket(4);
  bucket.grids = {grid};
  bucket.add(0, 2 * 3 + 0, 0.25f, 0.5f, 3.0f);  // a = (1/2, 1/2), b = (1, 1/2), d = (1, 1)
  bucket.finish_sample();
  bucket.add(0, 2 * 3 + 1, 0.25f, 0.5f, 3.0f);  // a, d, c = (1/2, 1)
  bucket.finish_sample();
  bucket.finish_sample();
  bucket.finish_sample();
  ShadedFragments out;
  ShadeCounters counters;
  shading->shade(bucket.input(), out, counters);
  CHECK(out.Ci[0][0] == Approx(0.25 * 0.5 + 0.25 * 1 + 0.5 * 1));
  CHECK(out.Ci[1][0] == Approx(0.25 * 0.5 + 0.25 * 0.5 + 0.5 * 1));
  CHECK(out.Ci[0][1] == Approx(0.25 * 0.5 + 0.25 * 1 + 0.5 * 0.5));
  CHECK(out.Ci[1][1] == Approx(0.25 * 0.5 + 0.25 * 1 + 0.5 * 1));
  CHECK(out.Oi[2][1] == 1.0f);
  CHECK(counters.points_shaded == 9);
}

TEST_CASE("ShadingInterpolation constant shows vertex a of each micropolygon") {
  TestScene test;
  Attributes attributes;
  attributes.surface = call("constant");
  attributes.smooth_shading = false;
  const auto grid = make_square(test.add_surface(attributes), 2, 3.0f);
  const auto Cs = add_primvar(*grid, "Cs", ValueType::color, [](float u, float v) {
    return std::vector<float>{u, v, 0.0f};
  });
  const auto shading = make_shading("reyes", {test.bind()});
  const TestBucket bucket = make_bucket({grid}, 8, 0);
  ShadedFragments out;
  ShadeCounters counters;
  shading->shade(bucket.input(), out, counters);
  for (size_t f = 0; f < 8; ++f) {
    const uint32_t m = bucket.fragments.triangle[f] / 2;
    CHECK(out.Ci[0][f] == float(m % 2) / 2.0f);
    CHECK(out.Ci[1][f] == float(m / 2) / 2.0f);
  }
}

TEST_CASE("only grids with a visible fragment are shaded, once, whoever asks") {
  TestScene test;
  const Surface& surface = test.add_surface("constant");
  const auto seen = make_square(surface, 4, 3.0f, 0), hidden = make_square(surface, 4, 4.0f, 1);
  const auto shading = make_shading("reyes", {test.bind()});
  TestBucket bucket = make_bucket({seen}, 10, 0);
  bucket.grids.push_back(hidden);
  ShadedFragments out;
  ShadeCounters counters;
  shading->shade(bucket.input(), out, counters);
  shading->shade(bucket.input(), out, counters);
  CHECK(counters.grids_shaded == 1);
  CHECK(counters.points_shaded == 25);
  CHECK(hidden->attachment == nullptr);
  CHECK(seen->attachment != nullptr);
}

TEST_CASE("many threads asking in any order get the same bits as one") {
  TestScene test;
  test.add_light(call("pointlight", {number("intensity", 20.0f)}));
  const Surface& surface = test.add_surface("marble");
  const auto make_grids = [&] {
    std::vector<std::shared_ptr<const Grid>> grids;
    for (uint32_t face = 0; face < 24; ++face) {
      grids.push_back(make_square(surface, 12, 2.0f + float(face), face));
    }
    return grids;
  };
  const auto bindings = test.bind();
  const int buckets = 16, samples = 300;
  const auto shade_all = [&](int thread_count, ShadeCounters& total) {
    const auto shading = make_shading("reyes", {bindings});
    const auto grids = make_grids();
    std::vector<ShadedFragments> results(buckets);
    std::vector<ShadeCounters> counters(size_t(thread_count), ShadeCounters{});
    std::vector<std::thread> threads;
    for (int t = 0; t < thread_count; ++t) {
      threads.emplace_back([&, t] {
        for (int b = t; b < buckets; b += thread_count) {
          const TestBucket bucket = make_bucket(grids, samples, b * 31);
          shading->shade(bucket.input(), results[size_t(b)], counters[size_t(t)]);
        }
      });
    }
    for (std::thread& thread : threads) thread.join();
    for (const ShadeCounters& c : counters) merge_counters(total, c);
    return results;
  };
  ShadeCounters alone_counters;
  const auto alone = shade_all(1, alone_counters);
  for (int round = 0; round < 4; ++round) {
    ShadeCounters counters;
    const auto together = shade_all(8, counters);
    for (size_t b = 0; b < buckets; ++b) CHECK(together[b].Ci == alone[b].Ci);
    CHECK(counters.grids_shaded == alone_counters.grids_shaded);
    CHECK(counters.light_evaluations == alone_counters.light_evaluations);
  }
}

TEST_CASE("values that are not finite are dropped, counted and blamed on their shader") {
  TestScene test;
  const auto grid = make_square(test.add_surface("constant"), 2, 3.0f);
  const auto Cs = add_primvar(*grid, "Cs", ValueType::color, [](float u, float v) {
    const bool bad = u == 0.0f && v == 0.0f;
    return std::vector<float>{0.5f, bad ? std::nanf("") : 0.5f, 1e30f};
  });
  const auto Os = add_primvar(*grid, "Os", ValueType::color, [](float u, float) {
    const float inf = std::numeric_limits<float>::infinity();
    return std::vector<float>{u == 1.0f ? inf : 0.5f, 2.0f, -1.0f};
  });
  const auto bindings = test.bind();
  const GridPoints batch(*grid, bindings->camera(), Footprints::over_micropolygons);
  SurfaceColors out;
  ShadeCounters counters;
  shade_surface(*bindings, bindings->of(grid->attributes()), batch.points(), FailedPoint::black,
                out, counters);
  CHECK(counters.nonfinite_dropped == 1 + 3);
  CHECK(out.Ci[0] == glm::vec3(0.0f));
  CHECK(out.Oi[0] == glm::vec3(0.5f, 1.0f, 0.0f));
  CHECK(out.Ci[1].y == 1.0f);
  for (int i = 0; i < 9; ++i) {
    for (int c = 0; c < 3; ++c) {
      CHECK(std::isfinite(out.Ci[i][c]));
      CHECK((out.Oi[i][c] >= 0.0f && out.Oi[i][c] <= 1.0f));
    }
  }
  CHECK(test.warned("\"constant\" gave values that are not finite"));
}

TEST_CASE("footprints are the change over one micropolygon") {
  TestScene test;
  const Surface& surface = test.add_surface("constant");
  const auto grid =
      make_grid(surface, 4, 2, [](float u, float v) { return glm::vec3(u * u, 3.0f * v, 1.0f); });
  test.bind();
  const GridPoints batch(*grid, *test.camera, Footprints::over_micropolygons);
  const ShadingPoints& points = batch.points();
  CHECK(points.st_footprint.dsdx[7] == Approx(0.25));
  CHECK(points.st_footprint.dtdy[7] == Approx(0.5));
  CHECK(points.st_footprint.dtdx[7] == Approx(0.0));
  CHECK(points.dPdx[7].x == Approx(0.25));    // central: d(u^2) = 2 u / 4 at u = 1/2
  CHECK(points.dPdx[5].x == Approx(0.0625));  // one-sided at u = 0
  CHECK(points.dPdy[7].y == Approx(1.5));
}
