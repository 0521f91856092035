#include <catch2/catch.hpp>

#include <array>
#include <cmath>

#include "images/exr.h"
#include "shade/light_terms.h"
#include "shade/surface_shading.h"
#include "tests/images/temporary_folder.h"
#include "tests/shade/fixtures.h"
#include "tests/shade/shadow_scene.h"

using namespace tessera;
using namespace tessera::test;

namespace {

/// Texels of the map along a side; its picture spans [-2, 2].
constexpr int map_size = 1024;

/// A matte square [-1, 1]^2 at depth 3, white, under an ambient light and a distant light from the
/// eye whose shadow map covers x < edge.
struct HalfShadow {
  TemporaryFolder folder;
  TestScene test;
  static constexpr double edge = 0.13;
  static constexpr float ambient = 0.25f, sun = 0.5f;

  explicit HalfShadow(const std::string& rate, const std::string& shader = "matte") {
    const MapCamera camera{{0, 0, 0}, false, 2.0, map_size};
    write_exr(folder.file("half.z"), depth_image(camera, [](const glm::dvec3& o, const auto&) {
                return o.x < edge ? 1.0 : 1e38;
              }));
    test.scene.file = folder.file("scene.rib");
    test.add_light(call("ambientlight", {number("intensity", ambient)}));
    test.add_light(call("distantlight", {number("intensity", sun), text("shadowname", "half.z"),
                                         text("shadowrate", rate)}));
    test.add_surface(shader);
  }
  const Surface& surface() const { return test.scene.surfaces.front(); }
  static float lit(bool by_sun) { return ambient + (by_sun ? sun : 0.0f); }
};

/// A row of `count` samples across the square at v = 0.4, all fragments of a grid of n x n.
TestBucket row_of_samples(const Surface& surface, int n, int count) {
  TestBucket bucket(count);
  bucket.grids = {make_square(surface, n, 3.0f)};
  for (int k = 0; k < count; ++k) {
    const float u = (float(k) + 0.5f) / float(count) * float(n), v = 0.4f * float(n);
    const int i = int(u), j = int(v);
    const float fu = u - float(i), fv = v - float(j);
    const auto m = uint32_t(j * n + i);
    // Triangle 0 = (a, b, d) where fu >= fv, 1 = (a, d, c) elsewhere.
    if (fu >= fv) {
      bucket.add(0, 2 * m, fu - fv, fv, 3.0f);
    } else {
      bucket.add(0, 2 * m + 1, fu, fv - fu, 3.0f);
    }
    bucket.finish_sample();
  }
  return bucket;
}

double x_of(int k, int count) { return 2.0 * (k + 0.5) / count - 1.0; }

struct Shaded {
  ShadedFragments fragments;
  ShadeCounters counters;
};

Shaded shade(const std::shared_ptr<const ShaderBindings>& bindings, const TestBucket& bucket) {
  Shaded result;
  make_shading("reyes", {bindings})->shade(bucket.input(), result.fragments, result.counters);
  return result;
}

}  // namespace

TEST_CASE("at sample rate every sample has its own shadow, however coarse the cells") {
  HalfShadow half("sample");
  const auto bindings = half.test.bind();
  CHECK(bindings->light_term_count() == 1);
  const int count = 400;
  const TestBucket bucket = row_of_samples(half.surface(), 2, count);
  const Shaded shaded = shade(bindings, bucket);
  for (int k = 0; k < count; ++k) {
    const double x = x_of(k, count);
    if (std::abs(x - HalfShadow::edge) < 2.0 * 4.0 / map_size) continue;
    CHECK(shaded.fragments.Ci[1][size_t(k)] == HalfShadow::lit(x > HalfShadow::edge));
  }
  CHECK(shaded.counters.shadow_lookups == count);
  CHECK(shaded.counters.light_evaluations == 2 * 9);
}

TEST_CASE("at cell rate the shadow is part of the vertices") {
  HalfShadow half("cell");
  const auto bindings = half.test.bind();
  CHECK(bindings->light_term_count() == 0);
  const int count = 100, n = 4;
  const Shaded shaded = shade(bindings, row_of_samples(half.surface(), n, count));
  for (int k = 0; k < count; ++k) {
    // Vertices lie at x = -1, -1/2, 0, 1/2, 1; the map covers the first three. Each cell's filter
    // is as wide as a cell, 1/2: at x = 0 a share 1/2 - 0.13 / 0.5 of it is lit, at 1/2 all.
    const double x = x_of(k, count), at_zero = 0.5 - HalfShadow::edge / 0.5;
    const double share = x < -0.5  ? 0.0
                         : x < 0.0 ? (x + 0.5) / 0.5 * at_zero
                         : x < 0.5 ? at_zero + x / 0.5 * (1.0 - at_zero)
                                   : 1.0;
    const double expected = double(HalfShadow::ambient) + double(HalfShadow::sun) * share;
    // Sixteen samples: strata of 1/16.
    CHECK(double(shaded.fragments.Ci[0][size_t(k)]) == Approx(expected).margin(0.5 / 16 + 0.005));
  }
  CHECK(shaded.counters.shadow_lookups == uint64_t((n + 1) * (n + 1)));
}

TEST_CASE("at pixel rate a grid has one shadow a pixel, over the pixel's footprint") {
  HalfShadow half("pixel");
  const auto bindings = half.test.bind();
  const int count = 400, per_pixel = 8;
  TestBucket bucket = row_of_samples(half.surface(), 2, count);
  bucket.samples.rect = {0, 0, count / per_pixel, 1};
  bucket.samples.samples_per_pixel = per_pixel;
  for (int k = 0; k < count; ++k) {
    bucket.samples.x.push_back((float(k) + 0.5f) / per_pixel);
    bucket.samples.y.push_back(0.5f);
  }
  // A second grid at the same place is another surface to every pixel.
  bucket.grids.push_back(make_square(half.surface(), 2, 3.0f, 1));
  for (int k = 0; k < count; k += 2) bucket.fragments.grid[size_t(k)] = 1;
  const Shaded shaded = shade(bindings, bucket);
  CHECK(shaded.counters.shadow_lookups == 2 * count / per_pixel);
  // 100 pixels over 90 degrees: at depth 3 a pixel is 0.06 wide.
  const double pixel = 0.06;
  int partial = 0;
  for (int k = 0; k < count; ++k) {
    // Samples of the two grids alternate; 3 and 4 of each pixel's 8 are nearest its middle.
    const int nearest = k / per_pixel * per_pixel + (k % 2 == 0 ? 4 : 3);
    const double share =
        std::clamp(0.5 + (x_of(nearest, count) - HalfShadow::edge) / pixel, 0.0, 1.0);
    partial += share > 0.0 && share < 1.0;
    const double expected = double(HalfShadow::ambient) + double(HalfShadow::sun) * share;
    const double found = double(shaded.fragments.Ci[2][size_t(k)]);
    CHECK(found == Approx(expected).margin(double(HalfShadow::sun) * (1.0 / 16 + 0.05)));
    CHECK(shaded.fragments.Ci[2][size_t(nearest)] == shaded.fragments.Ci[2][size_t(k)]);
  }
  CHECK(partial > 0);
}

TEST_CASE("coarse cells keep a sharp shadow at sample rate and blur it at cell rate") {
  const int count = 1024;
  const auto row = [&](const std::string& rate, int n) {
    HalfShadow half(rate);
    return shade(half.test.bind(), row_of_samples(half.surface(), n, count)).fragments.Ci[0];
  };
  const auto fine = row("cell", 256);
  const auto rmse = [&](const std::vector<float>& values) {
    double sum = 0.0;
    for (size_t k = 0; k < values.size(); ++k) {
      sum += (double(values[k]) - double(fine[k])) * (double(values[k]) - double(fine[k]));
    }
    return std::sqrt(sum / count);
  };
  const double at_cells = rmse(row("cell", 4)), at_samples = rmse(row("sample", 4));
  CAPTURE(at_cells, at_samples);
  CHECK(at_cells > 0.05);
  CHECK(at_samples < 0.2 * at_cells);
}

TEST_CASE("terms and the rest add up to the unseparated colour of every surface shader") {
  for (const ShaderDefinition& definition : shader_registry()) {
    if (definition.kind != ShaderKind::surface) continue;
    INFO(definition.name);
    HalfShadow together("cell", definition.name), apart("sample", definition.name);
    // No map: both lights shine everywhere.
    std::filesystem::remove(together.folder.file("half.z"));
    std::filesystem::remove(apart.folder.file("half.z"));
    const auto grid_together = make_square(together.surface(), 8, 3.0f);
    const auto grid_apart = make_square(apart.surface(), 8, 3.0f);
    const SurfaceColors whole = run_surface(*together.test.bind(), *grid_together);
    const SurfaceColors parts = run_surface(*apart.test.bind(), *grid_apart);
    REQUIRE(parts.light_terms.size() == 1);
    for (int i = 0; i < whole.Ci.count(); ++i) {
      const glm::vec3 sum = parts.Ci[i] + parts.light_terms[0][i];
      for (int c = 0; c < 3; ++c) CHECK(sum[c] == Approx(whole.Ci[i][c]).epsilon(1e-5));
    }
    CHECK(parts.Oi[0] == whole.Oi[0]);
    // Those that are lit have a term.
    const bool unlit = whole.Ci[40] == parts.Ci[40];
    const bool expect_unlit = definition.name == "constant" || definition.name == "fade" ||
                              definition.name == "defaultsurface";
    CHECK(unlit == expect_unlit);
  }
}

TEST_CASE("a surface that the light is not switched on for looks nothing up") {
  HalfShadow half("sample");
  Attributes attributes;
  attributes.surface = call("matte");
  half.test.scene.lights.clear();  // add_surface() lights it by all there are
  const Surface& unlit = half.test.add_surface(attributes);
  const auto light = [&](const std::string& file) {
    return call("distantlight", {text("shadowname", file), text("shadowrate", "sample")});
  };
  half.test.add_light(light("half.z"));
  half.test.add_light(light("half.z"));
  const auto bindings = half.test.bind();
  CHECK(bindings->light_term_count() == 2);
  const TestBucket bucket = row_of_samples(unlit, 2, 50);
  const Shaded shaded = shade(bindings, bucket);
  CHECK(shaded.counters.shadow_lookups == 0);
  for (const float value : shaded.fragments.Ci[0]) CHECK(value == 0.0f);
}

TEST_CASE("under motion the shadow sticks to where the surface was at shutter open") {
  HalfShadow half("sample");
  const auto bindings = half.test.bind();
  TestBucket bucket = row_of_samples(half.surface(), 2, 10);
  const auto grid = make_square(half.surface(), 2, 3.0f);
  add_key(*grid, 1.0f, [](const glm::vec3& P) { return P + 5.0f; });
  bucket.grids = {grid};
  bucket.samples.t.assign(10, 0.75f);
  const Shaded shaded = shade(bindings, bucket);
  for (int k = 0; k < 10; ++k) {
    CHECK(shaded.fragments.Ci[0][size_t(k)] == HalfShadow::lit(x_of(k, 10) > HalfShadow::edge));
  }
}

TEST_CASE("coarse micropolygons of a ball are not shadowed by the map's finer ball") {
  const TemporaryFolder folder;
  const glm::dvec3 centre(0.0, 0.0, 4.0);
  const MapCamera camera{{0, 0, 0}, true, 0.5, 1024};
  write_exr(folder.file("ball.z"), depth_image(camera, [&](const auto& o, const auto& d) {
              return hit_sphere(o, d, centre, 1.0);
            }));
  TestScene test, unshadowed;
  test.scene.file = folder.file("scene.rib");
  test.add_light(call("pointlight", {text("shadowname", "ball.z"), text("shadowrate", "sample")}));
  unshadowed.add_light(call("pointlight"));
  const Surface& surface = test.add_surface("matte");
  // A cap of the ball around its point nearest the eye, 0.2 from vertex to vertex: triangles lie up
  // to 0.2^2 / 4 = 0.01 inside, where a texel is 0.003 wide.
  const auto normal = [](float u, float v) {
    const float x = u - 0.5f, y = v - 0.5f;
    return glm::vec3(x, y, -std::sqrt(1.0f - x * x - y * y));
  };
  const auto grid =
      make_grid(surface, 5, 5, [&](float u, float v) { return glm::vec3(centre) + normal(u, v); });
  const size_t stride = grid->stride();
  for (size_t k = 0; k < size_t(grid->vertex_count()); ++k) {
    const glm::vec3 N = normal(grid->uv[k], grid->uv[stride + k]);
    for (int axis = 0; axis < 3; ++axis) grid->N_camera[size_t(axis) * stride + k] = N[axis];
  }
  TestBucket bucket(500);
  bucket.grids = {grid};
  for (uint32_t k = 0; k < 500; ++k) {
    bucket.add(0, k % 50, 0.3f, 0.35f, 3.0f);
    bucket.finish_sample();
  }
  const Shaded shaded = shade(test.bind(), bucket);
  CHECK(shaded.counters.shadow_lookups == 500);
  auto same_grid = make_grid(unshadowed.add_surface("matte"), 5, 5,
                             [&](float u, float v) { return glm::vec3(centre) + normal(u, v); });
  same_grid->N_camera = grid->N_camera;
  bucket.grids = {same_grid};
  const Shaded bare = shade(unshadowed.bind(), bucket);
  CHECK(bare.fragments.Ci[0][0] > 0.01f);
  CHECK(shaded.fragments.Ci[0] == bare.fragments.Ci[0]);
}

TEST_CASE("an unknown rate is said with the choices, and a rate without a map is nothing") {
  HalfShadow half("frame");
  CHECK(half.test.bind()->light_term_count() == 0);
  CHECK(half.test.warned("scene.rib:7:"));
  CHECK(half.test.warned("cell, pixel, sample"));
  TestScene without;
  without.add_light(call("spotlight", {text("shadowrate", "sample")}));
  CHECK(without.bind()->light_term_count() == 0);
  CHECK(without.diagnostics.lines().empty());
}
