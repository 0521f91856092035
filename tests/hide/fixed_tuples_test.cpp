// The hiders that rasterise once for each tuple, against the oracle on the samples made for them.

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <numeric>

#include <hwy/highway.h>

#include "base/error.h"
#include "tests/hide/random_scenes.h"

using namespace tessera;

namespace {

constexpr const char* all_hiders[] = {"interleave", "interleave:4", "interleave:1", "accumulate",
                                      "accumulate:1"};

/// Gives the bucket the samples that each hider wants, and compares with bbox on these.
void require_agreement(TestBucket& bucket, const PixelRect& rect, int spp, uint32_t seed) {
  for (const char* hider : all_hiders) {
    INFO(hider << ", " << spp << " samples a pixel");
    bucket.make_samples(rect, spp, seed, make_hider(hider)->sample_tuples(spp));
    HideCounters counters, brute;
    const FragmentList expected = bucket.hide("bbox", &brute);
    const FragmentList found = bucket.hide(hider, &counters);
    REQUIRE(same_fragments(expected, found));
    REQUIRE(counters.samples == bucket.samples.size());
    REQUIRE(counters.micropolygons == brute.micropolygons);
    REQUIRE(counters.fragments == found.size());
    REQUIRE(counters.samples_covered <= counters.samples_tested);
    REQUIRE(counters.samples_covered <= brute.samples_covered);
  }
}

}  // namespace

TEST_CASE("Rasterising tuple by tuple and brute force agree bit for bit") {
  for (const bool motion : {false, true})
    for (const bool lens : {false, true})
      for (const bool orthographic : {false, true})
        for (const int spp : {1, 3, 16}) {
          RandomOptions o{.motion = motion, .lens = lens, .orthographic = orthographic};
          for (uint32_t seed = 0; seed < 4; ++seed) {
            o.keys = 2 + int(seed % 3);
            INFO("motion " << motion << " lens " << lens << " orthographic " << orthographic
                           << " seed " << seed);
            // Tiles are cut on all sides, and not.
            const PixelRect rect = seed % 2 ? PixelRect{17, 9, 48, 40} : PixelRect{16, 8, 47, 39};
            TestBucket bucket = random_bucket(seed, o, rect, spp, 12);
            require_agreement(bucket, rect, spp, seed);
          }
        }
}

TEST_CASE("Rasterising tuple by tuple and brute force agree at the extremes") {
  const auto run = [](const char* name, const RandomOptions& base) {
    for (const bool motion : {false, true})
      for (const bool lens : {false, true}) {
        RandomOptions o = base;
        o.motion = motion, o.lens = lens;
        for (uint32_t seed = 100; seed < 106; ++seed) {
          INFO(name << ": motion " << motion << " lens " << lens << " seed " << seed);
          const PixelRect rect{9, 8, 32, 31};
          TestBucket bucket = random_bucket(seed, o, rect, 4, 10);
          require_agreement(bucket, rect, 4, seed);
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

TEST_CASE("Tuple by tuple: unusable vertices") {
  const float inf = std::numeric_limits<float>::infinity();
  for (const bool motion : {false, true})
    for (const float odd : {0.0f, std::nanf(""), inf, 1e30f, 1e16f, 1e-38f}) {
      CameraSettings settings = perspective_settings(32, 32);
      settings.lens = CameraSettings::ThinLens{2.0, 1.0, 4.5};
      TestBucket bucket(settings);
      std::mt19937 random(3);
      for (int g = 0; g < 3; ++g) {
        auto grid = random_grid(random, {.motion = motion, .reach = 1, .grid_size = 4});
        grid->P(grid->key_count() - 1, g)[grid->vertex_count() / 2] = odd;
        bucket.add(std::move(grid));
      }
      bucket.motion = motion;
      INFO("motion " << motion << " vertex " << odd);
      require_agreement(bucket, {0, 0, 32, 32}, 4, 1);
    }
}

TEST_CASE("Tuple by tuple: buckets of one pixel, empty buckets, transparent grids") {
  TestBucket one = random_bucket(1, {.motion = true, .lens = true}, {20, 20, 21, 21}, 16, 20);
  require_agreement(one, {21, 20, 22, 21}, 16, 2);
  TestBucket empty = random_bucket(1, {}, {20, 20, 21, 22}, 1, 0);
  require_agreement(empty, {20, 20, 21, 22}, 3, 2);
  for (const bool motion : {false, true})
    for (const bool lens : {false, true}) {
      const RandomOptions o{.motion = motion, .lens = lens, .reach = 2, .grid_size = 4};
      TestBucket bucket = random_bucket(21, o, {16, 8, 40, 32}, 5, 14);
      for (size_t g = 0; g < bucket.grids.size(); ++g) bucket.opaque.push_back(g % 3 == 0);
      require_agreement(bucket, {16, 8, 40, 32}, 5, 21);
      require_agreement(bucket, {17, 9, 40, 32}, 4, 22);
    }
}

TEST_CASE("Tuple by tuple: the same on every SIMD target of this machine") {
  TestBucket bucket = random_bucket(7, {.motion = true, .lens = true}, {16, 8, 40, 32}, 4, 12);
  TestBucket still = random_bucket(8, {}, {16, 8, 40, 32}, 4, 12);
  for (const int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    INFO("target " << hwy::TargetName(target));
    require_agreement(bucket, {16, 8, 40, 32}, 4, 3);
    require_agreement(still, {16, 8, 40, 32}, 4, 3);
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

namespace {

/// A grid of micropolygons of one pixel that fills the frame and moves by `path` pixels across it.
TestBucket pixel_grid(float path_pixels, bool lens) {
  CameraSettings settings = perspective_settings(64, 64, 90);
  // At depth 32 a pixel is one camera unit; the circle of confusion has a radius of some pixels.
  if (lens) settings.lens = CameraSettings::ThinLens{1.0, 0.1, 1.0};
  TestBucket bucket(settings);
  std::vector<float> keys{0.0f};
  if (path_pixels > 0) keys.push_back(1.0f);
  bucket.add(make_grid(120, 120, keys, [&](float u, float v, int key) {
    return glm::vec3(120 * (u - 0.5f) + 0.41f + float(key) * path_pixels, 120 * (v - 0.5f) + 0.37f,
                     32.0f);
  }));
  return bucket;
}

double ste(TestBucket& bucket, const char* hider) {
  bucket.make_samples({0, 0, 64, 64}, 16, 1, make_hider(hider)->sample_tuples(16));
  HideCounters counters;
  bucket.hide(hider, &counters);
  return double(counters.samples_covered) / double(counters.samples_tested);
}

}  // namespace

TEST_CASE("The efficiency of the sample test does not depend on blur") {
  // A quad of one pixel covers one tuple's share of a pixel. Off the pixels' borders its box
  // touches 2 pixels a side; in tiles of 2 pixels it touches 1.5 tiles on average, 3 pixels, a
  // side.
  const struct {
    const char* hider;
    double side_pixels;
  } expectations[] = {{"interleave", 3.0}, {"accumulate", 2.0}};
  for (const auto& [hider, side] : expectations)
    for (const float path : {0.0f, 7.3f, 31.7f})
      for (const bool lens : {false, true}) {
        TestBucket bucket = pixel_grid(path, lens);
        INFO(hider << " path " << path << " lens " << lens);
        CHECK(ste(bucket, hider) == Approx(1 / (side * side)).epsilon(0.05));
      }
}

TEST_CASE("Tests of each pixel add up to the samples tested") {
  TestBucket bucket = random_bucket(5, {.motion = true, .lens = true}, {17, 8, 48, 41}, 4, 12);
  for (const char* hider : all_hiders) {
    INFO(hider);
    const PixelRect rect{17, 8, 48, 41};
    bucket.make_samples(rect, 4, 5, make_hider(hider)->sample_tuples(4));
    std::vector<uint32_t> tests(size_t(rect.pixel_count()), 0);
    HideCounters counters, unasked;
    const FragmentList asked = bucket.hide(hider, &counters, tests);
    REQUIRE(same_fragments(asked, bucket.hide(hider, &unasked)));
    REQUIRE(counters.samples_tested == unasked.samples_tested);
    REQUIRE(counters.samples_tested > 0);
    REQUIRE(std::accumulate(tests.begin(), tests.end(), uint64_t(0)) == counters.samples_tested);
    std::fill(tests.begin(), tests.end(), 0u);
    HideCounters brute;
    bucket.hide("bbox", &brute, tests);
    REQUIRE(std::accumulate(tests.begin(), tests.end(), uint64_t(0)) == brute.samples_tested);
  }
}

TEST_CASE("Tuple by tuple: what is asked for in vain is refused") {
  CHECK_THROWS_AS(make_hider("interleave:x"), Error);
  CHECK_THROWS_AS(make_hider("interleave:0"), Error);
  CHECK_THROWS_AS(make_hider("accumulate:4,4"), Error);
  CHECK_THROWS_AS(make_hider("interleave:3")->sample_tuples(16), Error);
  CHECK_THROWS_AS(make_hider("accumulate:64")->sample_tuples(16), Error);
  CHECK(make_hider("interleave")->sample_tuples(9) ==
        SampleTuples{SampleTuples::Kind::interleaved, 36});
  CHECK(make_hider("interleave")->sample_tuples(65536).count == 1 << 17);
  CHECK(make_hider("accumulate")->sample_tuples(9) ==
        SampleTuples{SampleTuples::Kind::accumulated, 9});
  // Samples made for another hider.
  const TestBucket bucket = random_bucket(1, {}, {0, 0, 8, 8}, 4, 1);
  CHECK_THROWS_AS(bucket.hide("interleave"), Error);
}
