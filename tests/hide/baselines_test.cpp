/// The hiders that others are compared with: pixar and dual.

#include <catch2/catch.hpp>

#include <cmath>

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
      const TestBucket bucket =
          random_bucket(12, {.motion = motion, .lens = lens}, {16, 8, 45, 38}, 7, 20);
      for (const char* hider :
           {"bbox", "pixar:1x1x1", "pixar:2x2x4", "dual", "dual:3", "shear", "auto"}) {
        INFO(hider << " motion " << motion << " lens " << lens);
        HideCounters quiet, counted;
        bucket.hide(hider, &quiet);
        std::vector<uint32_t> tests_per_pixel(size_t(bucket.samples.rect.pixel_count()), 0);
        bucket.hide(hider, &counted, tests_per_pixel);
        uint64_t sum = 0;
        for (const uint32_t tests : tests_per_pixel) sum += tests;
        REQUIRE(sum == counted.samples_tested);
        REQUIRE(counted.samples_tested == quiet.samples_tested);
      }
    }
}

namespace {

/// A patch of 24 x 24 micropolygons of a pixel, tilted in depth, that crosses the picture by
/// `motion` pixels and has circles of confusion of radius `coc` pixels.
TestBucket pixel_sized(double motion, double coc) {
  constexpr double depth = 5;
  CameraSettings settings = perspective_settings(128, 128);
  const double scale = std::abs(double(Camera(settings).raster_clip().x_scale));
  // Focused at twice the depth, the radius is scale * aperture radius / (2 depth).
  const double aperture_radius = coc * 2 * depth / scale;
  if (coc > 0) settings.lens = CameraSettings::ThinLens{0.5 / aperture_radius, 1.0, 2 * depth};
  TestBucket bucket(settings);
  const RasterClipMap map = bucket.camera.raster_clip();
  const std::vector<float> keys = motion > 0 ? std::vector{0.0f, 1.0f} : std::vector{0.0f};
  bucket.add(make_grid(24, 24, keys, [&](float u, float v, int key) {
    const double step = key ? motion / std::sqrt(2.0) : 0.0;
    const double x = 32.3 + 24 * double(u) + 0.4 * std::sin(9 * double(v)) + step;
    const double y = 30.1 + 24 * double(v) + 0.4 * std::cos(8 * double(u)) + step;
    const double z = depth + 0.1 * double(u) + 0.2 * key;
    return glm::vec3((x - double(map.x_from_w)) * z / double(map.x_scale),
                     (y - double(map.y_from_w)) * z / double(map.y_scale), z);
  }));
  bucket.make_samples({0, 0, 128, 128}, 16, 3);
  return bucket;
}

double efficiency(const TestBucket& bucket, const char* hider) {
  HideCounters counters;
  bucket.hide(hider, &counters);
  return double(counters.samples_covered) / double(counters.samples_tested);
}

}  // namespace

TEST_CASE("Sample test efficiency: the paper's bounds hardly mind one effect, boxes do") {
  const double still = efficiency(pixel_sized(0, 0), "dual");
  REQUIRE(still == Approx(efficiency(pixel_sized(0, 0), "bbox")).epsilon(0.02));
  for (const auto& [motion, coc] : {std::pair(50.0, 0.0), std::pair(0.0, 20.0)}) {
    const TestBucket bucket = pixel_sized(motion, coc);
    const double bbox = efficiency(bucket, "bbox");
    const double pixar = efficiency(bucket, motion > 0 ? "pixar:1x1x16" : "pixar:4x4x1");
    const double dual = efficiency(bucket, "dual"), wide = efficiency(bucket, "dual:2");
    INFO("motion " << motion << " coc " << coc << ": still " << still << " bbox " << bbox
                   << " pixar " << pixar << " dual " << dual << " dual:2 " << wide);
    REQUIRE(dual == Approx(still).epsilon(0.2));
    REQUIRE(wide < dual);
    REQUIRE(pixar < wide);
    REQUIRE(bbox < 0.2 * pixar);
  }
  // Both at once, and equally strong: the covered samples lie in oblique slabs (the paper's section
  // 5), which intervals hold no better than strata do.
  const TestBucket both = pixel_sized(50, 20);
  REQUIRE(efficiency(both, "dual") < 0.05 * still);
  REQUIRE(efficiency(both, "dual") > efficiency(both, "pixar:2x2x4"));
  REQUIRE(efficiency(both, "pixar:2x2x4") > 2 * efficiency(both, "bbox"));
}
