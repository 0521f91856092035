#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <tuple>

#include <hwy/highway.h>

#include "tests/hide/random_scenes.h"

using namespace tessera;

namespace {

/// The hiders give the same fragments bit for bit, and bbox shares no bounds with shear and dual.
void require_agreement(const TestBucket& bucket) {
  const FragmentList expected = bucket.hide("bbox");
  for (const char* hider : {"auto", "shear", "shear:1", "shear:7", "pixar:1x1x1", "pixar:2x2x4",
                            "pixar:4x4x4", "pixar:3x1x5", "dual", "dual:2", "dual:5"}) {
    INFO(hider << ", " << expected.size() << " fragments expected");
    REQUIRE(same_fragments(expected, bucket.hide(hider)));
  }
}

}  // namespace

TEST_CASE("Dual bounds and brute force agree bit for bit") {
  for (const bool motion : {false, true})
    for (const bool lens : {false, true})
      for (const bool orthographic : {false, true})
        for (const int spp : {1, 3, 16, 17}) {
          RandomOptions o{.motion = motion, .lens = lens, .orthographic = orthographic};
          for (uint32_t seed = 0; seed < 4; ++seed) {
            o.keys = 2 + int(seed % 3);
            INFO("motion " << motion << " lens " << lens << " orthographic " << orthographic
                           << " spp " << spp << " seed " << seed);
            const TestBucket bucket = random_bucket(seed, o, {16, 8, 48, 40}, spp, 12);
            HideCounters counters;
            REQUIRE(bucket.hide("shear", &counters).size() > 0);
            REQUIRE(counters.samples_covered <= counters.samples_tested);
            require_agreement(bucket);
          }
        }
}

TEST_CASE("Dual bounds and brute force agree at the extremes") {
  const auto run = [](const char* name, const RandomOptions& base) {
    for (const bool motion : {false, true})
      for (const bool lens : {false, true}) {
        RandomOptions o = base;
        o.motion = motion, o.lens = lens;
        for (uint32_t seed = 100; seed < 106; ++seed) {
          INFO(name << ": motion " << motion << " lens " << lens << " seed " << seed);
          require_agreement(random_bucket(seed, o, {8, 8, 32, 32}, 4, 10));
        }
      }
  };
  run("around and behind the eye", {.reach = 2, .depth_min = -2, .depth_max = 2, .grid_size = 3});
  run("huge motion", {.depth_min = -3, .depth_max = 8, .speed = 100});
  run("focus inside the micropolygons", {.depth_min = 4, .depth_max = 5, .grid_size = 6});
  run("folded and inverted", {.roughness = 4});
  run("three keys through the eye", {.keys = 3, .depth_min = -1, .depth_max = 3, .speed = 4});
  run("tiny",
      {.reach = 1e-3f, .depth_min = 2e-3f, .depth_max = 8e-3f, .speed = 1e-3f, .grid_size = 1e-3f});
  run("vast",
      {.reach = 1e6f, .depth_min = 1e6f, .depth_max = 1e7f, .speed = 1e5f, .grid_size = 1e6f});
}

TEST_CASE("Degenerate and unusable vertices") {
  const float inf = std::numeric_limits<float>::infinity();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const bool motion : {false, true})
    for (const bool lens : {false, true})
      for (const float odd : {0.0f, nan, inf, -inf, 1e30f, 1e-38f}) {
        CameraSettings settings = perspective_settings(32, 32);
        if (lens) settings.lens = CameraSettings::ThinLens{2.0, 1.0, 4.5};
        TestBucket bucket(settings);
        std::mt19937 random(3);
        for (int g = 0; g < 4; ++g) {
          auto grid = random_grid(random, {.motion = motion, .reach = 1, .grid_size = 4});
          const int vertex = grid->vertex_count() / 2;
          const int last = grid->key_count() - 1;
          if (g == 0) grid->P(last, 2)[vertex] = odd;  // W
          if (g == 1) grid->P(last, 0)[vertex] = odd;  // X
          if (g == 2)
            for (int k = 0; k < 3; ++k) grid->P(0, k)[vertex] = odd;  // the eye
          if (g == 3)
            for (int i = 0; i < grid->vertex_count(); ++i) grid->P(0, 1)[i] = 0.0f;
          bucket.add(std::move(grid));
        }
        bucket.motion = motion;
        bucket.make_samples({0, 0, 32, 32}, 4, 1);
        INFO("motion " << motion << " lens " << lens << " vertex " << odd);
        require_agreement(bucket);
        HideCounters counters;
        const FragmentList list = bucket.hide("shear", &counters);
        for (size_t i = 0; i < list.size(); ++i) {
          REQUIRE(std::isfinite(list.z[i]));
          REQUIRE(std::isfinite(list.b1[i]));
        }
        if (!(std::abs(odd) <= 1e17f)) REQUIRE(counters.nonfinite_dropped > 0);
      }
}

TEST_CASE("Images of one pixel and empty buckets") {
  for (const int spp : {1, 3, 16, 17}) {
    require_agreement(random_bucket(1, {.motion = true, .lens = true}, {20, 20, 21, 21}, spp, 20));
    const TestBucket empty = random_bucket(1, {}, {20, 20, 21, 22}, spp, 0);
    const FragmentList list = empty.hide("shear");
    REQUIRE(list.size() == 0);
    REQUIRE(list.first_of_sample.size() == size_t(2 * spp + 1));
  }
}

TEST_CASE("Transparent surfaces: lists agree, are in order, and end at the first opaque one") {
  for (const bool motion : {false, true})
    for (const bool lens : {false, true})
      for (uint32_t seed = 20; seed < 24; ++seed) {
        TestBucket bucket =
            random_bucket(seed, {.motion = motion, .lens = lens, .reach = 2, .grid_size = 4},
                          {16, 8, 40, 32}, 5, 14);
        for (size_t g = 0; g < bucket.grids.size(); ++g) bucket.opaque.push_back(g % 3 == 0);
        // All hits on each grid alone, sorted by brute force.
        struct Entry {
          float z;
          uint32_t grid, triangle;
          bool operator<(const Entry& o) const {
            return std::tie(z, grid, triangle) < std::tie(o.z, o.grid, o.triangle);
          }
        };
        std::vector<std::vector<Entry>> expected(bucket.samples.size());
        TestBucket single =
            random_bucket(seed, {.motion = motion, .lens = lens}, {16, 8, 40, 32}, 5, 0);
        for (size_t g = 0; g < bucket.grids.size(); ++g) {
          single.grids.clear();
          single.grids.push_back(std::make_unique<Grid>());
          Grid& copy = *single.grids[0];
          copy.u_count = bucket.grids[g]->u_count, copy.v_count = bucket.grids[g]->v_count;
          copy.key_times = bucket.grids[g]->key_times, copy.P_camera = bucket.grids[g]->P_camera;
          single.opaque = {false};
          const FragmentList list = single.hide("bbox");
          for (size_t i = 0; i < list.size(); ++i)
            expected[list.sample[i]].push_back({list.z[i], uint32_t(g), list.triangle[i]});
        }
        const FragmentList list = bucket.hide("shear");
        REQUIRE(same_fragments(list, bucket.hide("bbox")));
        size_t longest = 0;
        for (size_t s = 0; s < expected.size(); ++s) {
          std::sort(expected[s].begin(), expected[s].end());
          size_t at = list.first_of_sample[s];
          for (const Entry& e : expected[s]) {
            REQUIRE(at < list.first_of_sample[s + 1]);
            REQUIRE(list.z[at] == e.z);
            REQUIRE(list.grid[at] == e.grid);
            REQUIRE(list.triangle[at] == e.triangle);
            ++at;
            if (bucket.opaque[e.grid]) break;
          }
          REQUIRE(at == list.first_of_sample[s + 1]);
          longest =
              std::max(longest, size_t(list.first_of_sample[s + 1] - list.first_of_sample[s]));
        }
        REQUIRE(longest >= 3);
      }
}

TEST_CASE("Everything a hider counts") {
  const TestBucket bucket = random_bucket(5, {}, {16, 8, 48, 40}, 16, 30);
  HideCounters brute, dual;
  const FragmentList list = bucket.hide("bbox", &brute);
  bucket.hide("shear", &dual);
  REQUIRE(brute.samples == bucket.samples.size());
  REQUIRE(brute.fragments == list.size());
  REQUIRE(dual.micropolygons == brute.micropolygons);
  REQUIRE(dual.micropolygons_culled > 0);
  REQUIRE(dual.samples_tested <= brute.samples_tested);
  REQUIRE(dual.samples_covered <= brute.samples_covered);
}

TEST_CASE("The hiders agree on every SIMD target of this machine") {
  // What other targets see may differ in the last bit where they have no fused multiply-add, and
  // with it the number of fragments by samples within rounding of an edge.
  const TestBucket bucket =
      random_bucket(7, {.motion = true, .lens = true}, {16, 8, 40, 32}, 16, 12);
  const TestBucket still = random_bucket(8, {}, {16, 8, 40, 32}, 16, 12);
  const double expected[2] = {double(bucket.hide("bbox").size()),
                              double(still.hide("bbox").size())};
  int targets = 0;
  for (const int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    INFO("target " << hwy::TargetName(target));
    require_agreement(bucket);
    require_agreement(still);
    REQUIRE(double(bucket.hide("shear").size()) == Approx(expected[0]).epsilon(1e-3));
    REQUIRE(double(still.hide("shear").size()) == Approx(expected[1]).epsilon(1e-3));
    ++targets;
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  REQUIRE(targets >= 1);
}
