/// Time-continuous triangles against the brute-force hider on the same samples. They round
/// differently, so they may differ where the long double rays say that rounding decides, and
/// nowhere else.

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "base/error.h"
#include "hide/lens_lines.h"
#include "hide/tct_edges.h"
#include "tests/hide/random_scenes.h"
#include "tests/hide/ray_oracle.h"

using namespace tessera;

namespace {

/// Moves the lens positions of a bucket's samples onto `count` lines through the lens centre, other
/// than those of SamplePattern: the hider finds out where they are.
void put_on_lines(TestBucket& bucket, uint32_t count) {
  SampleBlock& b = bucket.samples;
  b.tuple.assign(b.size() + simd_padding, 0);
  for (size_t s = 0; s < b.size(); ++s) {
    b.tuple[s] = uint32_t(s * 2654435761u >> 7) % count;
    const double angle = std::numbers::pi * (b.tuple[s] + 0.3) / count, along = b.u[s];
    b.u[s] = float(along * std::cos(angle)), b.v[s] = float(along * std::sin(angle));
  }
}

struct Differences {
  size_t samples = 0, hits = 0, differ = 0, deeper = 0;
  double worst_depth = 0;  ///< relative, among those that see the same
};

void compare_with_bbox(const TestBucket& bucket, const char* hider, Differences& d) {
  HideCounters brute, counters;
  const FragmentList expected = bucket.hide("bbox", &brute), list = bucket.hide(hider, &counters);
  REQUIRE(counters.samples_covered <= counters.samples_tested);
  REQUIRE(counters.nonfinite_dropped == brute.nonfinite_dropped);
  for (size_t s = 0; s < bucket.samples.size(); ++s) {
    const size_t a = expected.first_of_sample[s], b = list.first_of_sample[s];
    const bool seen = expected.first_of_sample[s + 1] > a;
    ++d.samples, d.hits += seen;
    if (seen == (list.first_of_sample[s + 1] > b)) {
      if (!seen) continue;
      const double error = std::abs(list.z[b] / expected.z[a] - 1);
      if (error <= 1e-5) {
        d.worst_depth = std::max(d.worst_depth, error);
        continue;
      }
      ++d.deeper;
    } else {
      ++d.differ;
    }
    const RayHit rays = trace(bucket, s);
    const Comparison c = compare(rays, list, s);
    INFO(hider << " sample " << s << " at " << bucket.samples.x[s] << " " << bucket.samples.y[s]
               << ", depth error " << double(c.depth_error));
    REQUIRE((rays.doubtful || c.agrees));
  }
}

}  // namespace

TEST_CASE("Time-continuous triangles see what brute force sees but for rounding") {
  for (const bool orthographic : {false, true})
    for (const bool motion : {false, true})
      for (const bool lens : {false, true}) {
        Differences d;
        for (const int spp : {1, 3, 16, 17})
          for (uint32_t seed = 0; seed < 4; ++seed) {
            const RandomOptions o{.motion = motion,
                                  .lens = lens,
                                  .orthographic = orthographic,
                                  .keys = 2 + int(seed % 3)};
            TestBucket bucket = random_bucket(seed, o, {16, 8, 48, 40}, spp, 12);
            compare_with_bbox(bucket, "tct", d);
            if (!lens) continue;
            for (const char* hider : {"tct:1", "tct:8"}) {
              bucket.make_samples({16, 8, 48, 40}, spp, seed,
                                  make_hider(hider)->sample_tuples(spp));
              compare_with_bbox(bucket, hider, d);
            }
          }
        INFO("orthographic " << orthographic << " motion " << motion << " lens " << lens << ": "
                             << d.differ << " differ and " << d.deeper << " differ in depth of "
                             << d.samples << " samples, " << d.hits
                             << " hits; otherwise the worst relative depth error is "
                             << d.worst_depth);
        CHECK(d.hits > d.samples / 10);
        REQUIRE(double(d.differ + d.deeper) < 1e-4 * double(d.samples));
      }
}

TEST_CASE("Time-continuous triangles at the extremes") {
  const auto run = [](const char* name, const RandomOptions& base) {
    Differences d;
    for (const bool motion : {false, true})
      for (const bool lens : {false, true}) {
        RandomOptions o = base;
        o.motion = motion, o.lens = lens;
        for (uint32_t seed = 100; seed < 106; ++seed) {
          INFO(name << ": motion " << motion << " lens " << lens << " seed " << seed);
          TestBucket bucket = random_bucket(seed, o, {8, 8, 32, 32}, 4, 10);
          compare_with_bbox(bucket, "tct", d);
          if (!lens) continue;
          put_on_lines(bucket, 5);
          compare_with_bbox(bucket, "tct:5", d);
        }
      }
    INFO(name << ": " << d.differ << " differ and " << d.deeper << " differ in depth of "
              << d.samples << " samples, " << d.hits << " hits");
    CHECK(d.hits > 0);
    REQUIRE(double(d.differ + d.deeper) < 1e-3 * double(d.samples));
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

TEST_CASE("Time-continuous triangles with degenerate and unusable vertices") {
  const float inf = std::numeric_limits<float>::infinity();
  for (const bool motion : {false, true})
    for (const float odd : {0.0f, inf, -inf, 1e30f, 1e-38f, 1e16f}) {
      CameraSettings settings = perspective_settings(32, 32);
      settings.lens = CameraSettings::ThinLens{2.0, 1.0, 4.5};
      TestBucket bucket(settings);
      std::mt19937 random(3);
      for (int g = 0; g < 4; ++g) {
        auto grid = random_grid(random, {.motion = motion, .reach = 1, .grid_size = 4});
        const int vertex = grid->vertex_count() / 2, last = grid->key_count() - 1;
        if (g < 2) grid->P(last, g == 0 ? 2 : 0)[vertex] = odd;
        for (int k = 0; g == 2 && k < 3; ++k) grid->P(0, k)[vertex] = odd;
        for (int i = 0; g == 3 && i < grid->vertex_count(); ++i) grid->P(0, 1)[i] = 0.0f;
        bucket.add(std::move(grid));
      }
      bucket.motion = motion;
      bucket.make_samples({0, 0, 32, 32}, 4, 1);
      put_on_lines(bucket, 3);
      for (const char* hider : {"tct", "tct:3"}) {
        HideCounters counters, brute;
        const FragmentList list = bucket.hide(hider, &counters);
        const FragmentList expected = bucket.hide("bbox", &brute);
        INFO(hider << " motion " << motion << " vertex " << odd);
        REQUIRE(counters.nonfinite_dropped == brute.nonfinite_dropped);
        REQUIRE(double(list.size()) == Approx(double(expected.size())).epsilon(1e-3));
        for (size_t i = 0; i < list.size(); ++i) {
          REQUIRE(std::isfinite(list.z[i]));
          REQUIRE(std::isfinite(list.b1[i]));
        }
      }
    }
}

TEST_CASE("Time-continuous triangles keep what is transparent") {
  for (const bool motion : {false, true}) {
    TestBucket bucket = random_bucket(
        20, {.motion = motion, .lens = true, .reach = 2, .grid_size = 4}, {16, 8, 40, 32}, 5, 14);
    for (size_t g = 0; g < bucket.grids.size(); ++g) bucket.opaque.push_back(g % 3 == 0);
    put_on_lines(bucket, 4);
    const FragmentList expected = bucket.hide("bbox");
    REQUIRE(expected.size() > bucket.samples.size());
    for (const char* hider : {"tct", "tct:4"}) {
      const FragmentList list = bucket.hide(hider);
      for (size_t s = 0; s < bucket.samples.size(); ++s) {
        const size_t a = expected.first_of_sample[s], b = list.first_of_sample[s];
        if (list.first_of_sample[s + 1] - b != expected.first_of_sample[s + 1] - a) {
          REQUIRE(trace(bucket, s).doubtful);
          continue;
        }
        for (size_t k = 0; k < expected.first_of_sample[s + 1] - a; ++k)
          REQUIRE(list.z[b + k] == Approx(double(expected.z[a + k])).epsilon(1e-5));
      }
    }
  }
}

TEST_CASE("What time-continuous triangles count") {
  TestBucket bucket = random_bucket(5, {.motion = true, .lens = true}, {16, 8, 48, 40}, 16, 30);
  put_on_lines(bucket, 8);
  for (const char* hider : {"tct", "tct:8"}) {
    HideCounters counters;
    std::vector<uint32_t> tests(size_t(bucket.samples.rect.pixel_count()), 0);
    const FragmentList list = bucket.hide(hider, &counters, tests);
    REQUIRE(counters.samples == bucket.samples.size());
    REQUIRE(counters.fragments == list.size());
    REQUIRE(counters.micropolygons_culled > 0);
    REQUIRE(std::accumulate(tests.begin(), tests.end(), uint64_t(0)) == counters.samples_tested);
  }
}

namespace {

/// A row of micropolygons two pixels wide that move 40 pixels down a diagonal, or are out of focus.
TestBucket small_micropolygons(bool motion, bool lens) {
  CameraSettings settings = perspective_settings(64, 64, 90);
  if (lens) settings.lens = CameraSettings::ThinLens{1.0, 1.0, 2.0};
  TestBucket bucket(settings);
  bucket.add(make_grid(16, 1, motion ? std::vector<float>{0, 1} : std::vector<float>{0},
                       [](float u, float v, int key) {
                         const float k = float(key);
                         return glm::vec3(u - 0.5f + k, v * 0.0625f + k, 1.0f);
                       }));
  bucket.make_samples({0, 0, 64, 64}, 64, 1, {SampleTuples::Kind::lens_lines, 16});
  return bucket;
}

}  // namespace

TEST_CASE("Boxes along motion and along lens lines are tighter than upright ones") {
  const auto tested = [](bool motion, bool lens, const char* hider) {
    HideCounters counters;
    small_micropolygons(motion, lens).hide(hider, &counters);
    return double(counters.samples_tested);
  };
  REQUIRE(tested(true, false, "tct") < 0.25 * tested(true, false, "bbox"));
  REQUIRE(tested(false, true, "tct") == Approx(tested(false, true, "bbox")).epsilon(0.01));
  REQUIRE(tested(false, true, "tct:16") < 0.4 * tested(false, true, "bbox"));
  REQUIRE(tested(true, true, "tct:16") < 0.7 * tested(true, true, "tct"));
  // A closed lens has no lines.
  REQUIRE(tested(true, false, "tct:16") == tested(true, false, "tct"));
}

TEST_CASE("Boxes around small micropolygons miss nothing") {
  for (const bool motion : {false, true})
    for (const bool lens : {false, true}) {
      INFO("motion " << motion << " lens " << lens);
      Differences d;
      const TestBucket bucket = small_micropolygons(motion, lens);
      for (const char* hider : {"tct", "tct:16"}) compare_with_bbox(bucket, hider, d);
      REQUIRE(d.hits > 1000);
      REQUIRE(d.differ + d.deeper < 4);
    }
}

TEST_CASE("Samples arranged by lens line are all there, in order") {
  TestBucket bucket = random_bucket(1, {.motion = true, .lens = true}, {3, 5, 14, 12}, 7, 0);
  put_on_lines(bucket, 6);
  const SampleBlock& b = bucket.samples;
  LensLines lines;
  REQUIRE_THROWS_AS(lines.arrange(b, 5), Error);
  lines.arrange(b, 6);
  const size_t pixels = size_t(b.rect.pixel_count());
  std::vector<int> seen(b.size(), 0);
  for (int line = 0; line < 6; ++line)
    for (size_t p = 0; p < pixels; ++p)
      for (size_t k = lines.first(line, p); k < lines.first(line, p + 1); ++k) {
        const size_t s = lines.index()[k];
        REQUIRE(b.tuple[s] == uint32_t(line));
        REQUIRE(s / 7 == p);
        REQUIRE(lines.samples().x[k] == b.x[s]);
        REQUIRE(lines.samples().v[k] == b.v[s]);
        REQUIRE(lines.samples().t[k] == b.t[s]);
        const LensRegion& r = lines.region(line);
        REQUIRE(r.box < 1e-6);
        REQUIRE(std::abs(b.u[s] * r.v - b.v[s] * r.u) < 1e-6);
        ++seen[s];
      }
  for (const int count : seen) REQUIRE(count == 1);
}

TEST_CASE("The tct hider refuses bad arguments, and names its samples") {
  for (const char* bad : {"tct:0", "tct:65", "tct:x", "tct:4x", "tct:-1"})
    REQUIRE_THROWS_AS(make_hider(bad), Error);
  REQUIRE(make_hider("tct")->sample_tuples(16) == SampleTuples{});
  REQUIRE(make_hider("tct:8")->sample_tuples(16) ==
          SampleTuples{SampleTuples::Kind::lens_lines, 8});
}
