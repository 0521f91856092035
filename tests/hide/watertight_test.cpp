#include <catch2/catch.hpp>

#include <cmath>

#include "hide/edge_sign.h"
#include "tests/hide/hide_fixture.h"

using namespace tessera;

namespace {

/// A sheet of 3 x 3 grids of 7 x 5 micropolygons that covers the view at depth about z, its inner
/// vertices scattered; neighbouring grids share their border vertices bit for bit.
void add_sheet(TestBucket& bucket, uint32_t seed, float z, bool moves) {
  const auto scattered = [=](int i, int j, int key) {
    std::seed_seq sequence{seed, uint32_t(i), uint32_t(j), uint32_t(key)};
    std::mt19937 random(sequence);
    std::uniform_real_distribution<float> unit(-1, 1);
    const float x = (float(i) - 10.5f) / 10.5f * 1.4f * z, y = (float(j) - 7.5f) / 7.5f * 1.4f * z;
    const float jitter = 0.03f * z;
    return glm::vec3(x + jitter * unit(random), y + jitter * unit(random),
                     z + jitter * unit(random));
  };
  for (int gy = 0; gy < 3; ++gy)
    for (int gx = 0; gx < 3; ++gx)
      bucket.add(make_grid(7, 5, moves ? std::vector<float>{0, 1} : std::vector<float>{0},
                           [&](float u, float v, int key) {
                             return scattered(gx * 7 + int(std::lround(u * 7)),
                                              gy * 5 + int(std::lround(v * 5)), key);
                           }));
}

TestBucket sheets(bool motion, bool lens, int layers) {
  CameraSettings settings = perspective_settings(24, 24);
  if (lens) settings.lens = CameraSettings::ThinLens{8.0, 1.0, 4.5};
  TestBucket bucket(settings);
  for (int k = 0; k < layers; ++k) add_sheet(bucket, uint32_t(k), 2.0f + float(k), motion);
  bucket.opaque.assign(bucket.grids.size(), false);  // so that all layers are reported
  bucket.motion = motion;
  return bucket;
}

void require_layers(const TestBucket& bucket, int layers) {
  for (const char* hider : {"bbox", "shear"}) {
    const FragmentList list = bucket.hide(hider);
    for (size_t s = 0; s < bucket.samples.size(); ++s) {
      INFO(hider << " sample " << s << " at " << bucket.samples.x[s] << " " << bucket.samples.y[s]);
      REQUIRE(list.first_of_sample[s + 1] - list.first_of_sample[s] == uint32_t(layers));
      for (int k = 0; k < layers; ++k)
        REQUIRE(int(list.grid[list.first_of_sample[s] + uint32_t(k)]) / 9 == k);
    }
  }
}

}  // namespace

TEST_CASE("Every sample meets every layer of closed sheets exactly once") {
  for (const bool motion : {false, true})
    for (const bool lens : {false, true}) {
      INFO("motion " << motion << " lens " << lens);
      TestBucket bucket = sheets(motion, lens, 3);
      bucket.make_samples({0, 0, 24, 24}, 64, 11);
      require_layers(bucket, 3);
    }
}

TEST_CASE("Samples exactly on shared vertices, edges and diagonals meet a sheet exactly once") {
  // Vertices on whole and half pixels, exactly: W = 2, x_scale a power of two.
  for (const bool moves : {false, true}) {
    CameraSettings settings = perspective_settings(16, 16, 90);
    TestBucket bucket(settings);
    // A vertex at pixel (px, py) of a 16 pixel frame: x = (px / 8 - 1) z.
    for (int g = 0; g < 4; ++g)
      bucket.add(make_grid(5, 5, moves ? std::vector<float>{0, 1} : std::vector<float>{0},
                           [&](float u, float v, int key) {
                             const float px = -2 + 10.0f * float(g % 2) + 2 * std::round(u * 5);
                             const float py = -2 + 10.0f * float(g / 2) + 2 * std::round(v * 5);
                             const float z =
                                 key ? 4.0f : 2.0f;  // straight away from the eye: fixed on screen
                             return glm::vec3((px / 8 - 1) * z, (1 - py / 8) * z, z);
                           }));
    bucket.opaque.assign(4, false);
    bucket.make_samples({0, 0, 16, 16}, 4, 1);
    bucket.samples.y_stratified = false;
    for (size_t s = 0; s < bucket.samples.size(); ++s) {
      const int p = int(s / 4), k = int(s % 4);
      // Corner, middles of the two near sides, and centre of each pixel: on vertices, edges and
      // diagonals for half of the pixels, inside for the others.
      bucket.samples.x[s] = float(p % 16) + 0.5f * float(k % 2);
      bucket.samples.y[s] = float(p / 16) + 0.5f * float(k / 2);
    }
    for (const char* hider : {"bbox", "shear"}) {
      const FragmentList list = bucket.hide(hider);
      for (size_t s = 0; s < bucket.samples.size(); ++s) {
        INFO(hider << " sample at " << bucket.samples.x[s] << " " << bucket.samples.y[s]);
        REQUIRE(list.first_of_sample[s + 1] - list.first_of_sample[s] == 1);
      }
    }
  }
}

TEST_CASE("Samples on the projected vertices of a scattered sheet meet it exactly once") {
  TestBucket bucket = sheets(false, false, 2);
  bucket.make_samples({0, 0, 24, 24}, 16, 3);
  bucket.samples.y_stratified = false;
  // As near as floats come to the vertices, so that the edge functions round to zero now and then.
  size_t s = 0;
  for (const auto& grid : bucket.grids)
    for (int i = 0; i < grid->vertex_count(); ++i) {
      const glm::vec3 clip = bucket.camera.raster_clip_from_camera(
          {grid->P(0, 0)[i], grid->P(0, 1)[i], grid->P(0, 2)[i]});
      const float x = clip.x / clip.z, y = clip.y / clip.z;
      if (x < 0 || y < 0 || x >= 24 || y >= 24) continue;
      s = (size_t(y) * 24 + size_t(x)) * 16 + size_t(i % 16);
      bucket.samples.x[s] = x, bucket.samples.y[s] = y;
    }
  REQUIRE(s > 0);
  require_layers(bucket, 2);
}

TEST_CASE("Edge signs are exact and antisymmetric") {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> small(-3, 3);
  std::uniform_real_distribution<float> unit(-1, 1);
  int ties = 0;
  for (int k = 0; k < 200000; ++k) {
    SeenVertex i, j;
    if (k % 2) {
      i = {float(small(random)), float(small(random)), float(small(random))};
      j = {float(small(random)), float(small(random)), float(small(random))};
    } else {  // nearly parallel: the products agree to the last bits
      i = {unit(random), unit(random), unit(random)};
      const float f = unit(random);
      j = {f * i.dx, f * i.dy, f * i.W};
    }
    const int sign = edge_sign(i, j);
    REQUIRE(sign == -edge_sign(j, i));
    // The x87 long double holds products of floats, and their difference to well below this.
    using Real = long double;
    const Real e = Real(i.dx) * j.dy - Real(j.dx) * i.dy;
    const Real e1 = Real(j.W) * i.dy - Real(i.W) * j.dy, e2 = Real(j.dx) * i.W - Real(i.dx) * j.W;
    const Real decides = e != 0 ? e : e1 != 0 ? e1 : e2;
    REQUIRE(sign == (decides > 0) - (decides < 0));
    ties += e == 0;
  }
  REQUIRE(ties > 10000);
}
