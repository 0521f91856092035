/// The hiders that others are compared with: pixar and dual.

#include <catch2/catch.hpp>

#include "base/error.h"
#include "tests/hide/random_scenes.h"

using namespace tessera;

TEST_CASE("One stratum of the whole lens and shutter tests what bbox tests") {
  for (const bool motion : {false, true})
    for (const bool lens : {false, true})
      for (const float depth_min : {2.0f, -2.0f}) {
        const TestBucket bucket =
            random_bucket(11, {.motion = motion, .lens = lens, .keys = 3, .depth_min = depth_min},
                          {16, 8, 48, 40}, 9, 20);
        HideCounters bbox, one, many;
        bucket.hide("bbox", &bbox);
        bucket.hide("pixar:1x1x1", &one);
        bucket.hide("pixar:4x4x8", &many);
        INFO("motion " << motion << " lens " << lens << " depth from " << depth_min);
        REQUIRE(one.samples_tested == bbox.samples_tested);
        REQUIRE(one.samples_covered == bbox.samples_covered);
        REQUIRE(many.samples_covered == bbox.samples_covered);
        if (motion || lens) REQUIRE(many.samples_tested < bbox.samples_tested);
        if (!motion && !lens) REQUIRE(many.samples_tested == bbox.samples_tested);
      }
}

TEST_CASE("Bad arguments of the baseline hiders are refused") {
  for (const char* spec :
       {"pixar:0x1x1",  "pixar:1x0x1",   "pixar:1x1x0",    "pixar:65x1x1",
        "pixar:1x1x65", "pixar:-1x1x1",  "pixar:2",        "pixar:2x2",
        "pixar:2x2x",   "pixar:2x2x4x",  "pixar:2x2x4x1",  "pixar:2x2x4 ",
        "pixar:axbxc",  "pixar:2.5x1x1", "pixar:64x64x64", "pixar:99999999999x1x1",
        "dual:0",       "dual:65",       "dual:-1",        "dual:x",
        "dual:2.5",     "dual:2x2",      "dual: 1"}) {
    INFO(spec);
    REQUIRE_THROWS_AS(make_hider(spec), Error);
  }
  for (const char* spec :
       {"pixar", "pixar:", "pixar:1x1x64", "pixar:8x8x64", "dual", "dual:", "dual:64"})
    REQUIRE_NOTHROW(make_hider(spec));
}

TEST_CASE("Tests are counted for each pixel if somebody asks") {
  for (const bool motion : {false, true})
    for (const bool lens : {false, true}) {
      TestBucket bucket =
          random_bucket(12, {.motion = motion, .lens = lens}, {16, 8, 45, 38}, 7, 20);
      for (const char* hider : {"bbox", "pixar:1x1x1", "pixar:2x2x4", "dual", "dual:3"}) {
        INFO(hider << " motion " << motion << " lens " << lens);
        HideCounters quiet, counted;
        bucket.hide(hider, &quiet);
        bucket.tests_per_pixel.assign(size_t(bucket.samples.rect.pixel_count()), 0);
        bucket.hide(hider, &counted);
        uint64_t sum = 0;
        for (const uint32_t tests : bucket.tests_per_pixel) sum += tests;
        bucket.tests_per_pixel.clear();
        REQUIRE(sum == counted.samples_tested);
        REQUIRE(counted.samples_tested == quiet.samples_tested);
      }
    }
}
