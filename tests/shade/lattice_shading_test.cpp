// What each shading mode shows, against the value at the point that its definition says.

#include <catch2/catch.hpp>

#include <algorithm>
#include <set>
#include <thread>

#include "tests/shade/space_fixtures.h"

using namespace tessera;
using namespace tessera::test;
using Catch::Matchers::Contains;

namespace {

/// The square [-1, 1]^2 at depth 3 fills the raster from 100/3 to 200/3, and a colour that is
/// linear over it is linear on the raster too.
constexpr double raster_low = 100.0 / 3, raster_side = 100.0 / 3;

/// Colour at (u, v) of make_square(); v runs up, the raster down.
glm::dvec3 color_at(double u, double v) { return {u, v, 2 * u - v + 1}; }
glm::dvec3 color_seen_at(const glm::dvec2& raster) {
  return color_at((raster.x - raster_low) / raster_side, 1 - (raster.y - raster_low) / raster_side);
}

struct ModeScene : TestScene {
  std::vector<std::shared_ptr<Parameter>> sources;

  std::shared_ptr<Grid> colored_square(const Surface& surface, int count, uint32_t face = 0) {
    auto grid = make_square(surface, count, 3.0f, face);
    sources.push_back(add_primvar(*grid, "Cs", ValueType::color, [](float u, float v) {
      const glm::dvec3 c = color_at(u, v);
      return std::vector<float>{float(c.x), float(c.y), float(c.z)};
    }));
    return grid;
  }
};

/// Makes a grid move by `shift` in camera space over the shutter.
void move(Grid& grid, const std::function<glm::vec3(const glm::vec3&)>& shift) {
  add_key(grid, 1.0f, [&](const glm::vec3& P) { return P + shift(P); });
}

/// A sample for each of `points`.
TestBucket bucket_of(const std::shared_ptr<const Grid>& grid,
                     const std::vector<SurfacePoint>& points) {
  TestBucket bucket(int(points.size()));
  bucket.grids = {grid};
  for (const SurfacePoint& p : points) {
    bucket.add(0, p.triangle, p.b1, p.b2, 3.0f);
    bucket.finish_sample();
  }
  return bucket;
}

glm::dvec3 color_of(const ShadedFragments& out, size_t f) {
  return {out.Ci[0][f], out.Ci[1][f], out.Ci[2][f]};
}

bool at_border(const glm::dvec2& in_cells) {
  const glm::dvec2 off = glm::abs(in_cells - glm::round(in_cells));
  return std::min(off.x, off.y) < 1e-3;
}

struct Run {
  ShadedFragments out;
  ShadeCounters counters;
};

Run run(Shading& shading, const TestBucket& bucket) {
  Run result;
  shading.shade(bucket.input(), result.out, result.counters);
  return result;
}

}  // namespace

TEST_CASE("ds shows the colour at the centre of the pixel that a point lies in at shutter open") {
  ModeScene test;
  for (const float shading_rate : {1.0f, 6.25f, 0.3f}) {
    Attributes attributes;
    attributes.surface = call("constant");
    attributes.shading_rate = shading_rate;
    const auto grid = test.colored_square(test.add_surface(attributes), 16);
    move(*grid, [](const glm::vec3& P) { return glm::vec3(0.5f, P.x, P.y); });
    const ShadingFrame frame{test.bind(), true, false};
    const auto shading = make_shading("ds", frame);
    const auto points = inner_points(*grid, 8);
    const Run ds = run(*shading, bucket_of(grid, points));
    const double side = std::sqrt(double(shading_rate));
    std::set<std::pair<int, int>> cells;
    double worst = 0;
    for (size_t f = 0; f < points.size(); ++f) {
      const glm::dvec2 in_cells = raster_of(*grid, points[f]) / side, cell = glm::floor(in_cells);
      cells.insert({int(cell.x), int(cell.y)});
      if (at_border(in_cells)) continue;
      // Where the square's rim cuts the cell off from its centre, the nearest point of the square.
      const glm::dvec2 at = glm::clamp((cell + 0.5) * side, raster_low, raster_low + raster_side);
      worst = std::max(worst, glm::length(color_of(ds.out, f) - color_seen_at(at)));
    }
    CHECK(worst < 1e-4);
    CHECK(double(ds.counters.points_shaded) == Approx(double(cells.size())).margin(1));
    CHECK(ds.counters.grids_shaded == 1);
  }
}

TEST_CASE("aas shows the colour at the centres of cells as wide as the blur allows") {
  ModeScene test;
  test.scene.camera.shutter_close = 1;
  const Surface& surface = test.add_surface("constant");
  const ShadingFrame frame{test.bind(), true, false};
  const double shutter = test.camera->shutter_profile().band_limit(0.8);
  // One unit at depth 3 is 50 / 3 pixels.
  for (const double pixels : {12.0, 60.0}) {
    for (const double angle : {0.0, 0.7}) {
      const glm::dvec2 motion(std::cos(angle), std::sin(angle));
      const auto grid = test.colored_square(surface, 16);
      move(*grid, [&](const glm::vec3&) {
        return glm::vec3(float(motion.x * pixels * 0.06), float(-motion.y * pixels * 0.06), 0);
      });
      const auto shading = make_shading("aas:shutter=0.8", frame);
      const auto points = inner_points(*grid, 8);
      const Run aas = run(*shading, bucket_of(grid, points));
      const double d_mu = std::min(1.0, 2 * shutter / pixels);
      const glm::dvec2 e = motion, across(-e.y, e.x);
      const double span = raster_side * (std::abs(e.x) + std::abs(e.y));
      const double along_cells = std::ceil(span * d_mu), across_cells = std::ceil(span);
      std::set<std::pair<int, int>> cells;
      double worst = 0;
      for (size_t f = 0; f < points.size(); ++f) {
        const glm::dvec2 from_centre = raster_of(*grid, points[f]) - 50.0;
        const glm::dvec2 in_cells((glm::dot(e, from_centre) / span + 0.5) * along_cells,
                                  (glm::dot(across, from_centre) / span + 0.5) * across_cells);
        const glm::dvec2 cell = glm::floor(in_cells);
        cells.insert({int(cell.x), int(cell.y)});
        if (at_border(in_cells)) continue;
        const glm::dvec2 at = 50.0 + ((cell.x + 0.5) / along_cells - 0.5) * span * e +
                              ((cell.y + 0.5) / across_cells - 0.5) * span * across;
        const bool inside = std::max(std::abs(at.x - 50), std::abs(at.y - 50)) < raster_side / 2;
        if (!inside) continue;
        worst = std::max(worst, glm::length(color_of(aas.out, f) - color_seen_at(at)));
      }
      INFO(pixels << " pixels at " << angle);
      CHECK(worst < 3e-4);
      CHECK(double(aas.counters.points_shaded) == Approx(double(cells.size())).margin(3));
    }
  }
}

TEST_CASE("sample shows every point's own colour, pixel the first of a micropolygon in a pixel") {
  ModeScene test;
  const auto grid = test.colored_square(test.add_surface("constant"), 4);
  const ShadingFrame frame{test.bind()};
  const auto points = inner_points(*grid, 10);
  TestBucket bucket = bucket_of(grid, points);
  const auto sample = make_shading("sample", frame), pixel = make_shading("pixel", frame);
  const Run all = run(*sample, bucket);
  for (size_t f = 0; f < points.size(); ++f)
    CHECK(glm::length(color_of(all.out, f) - color_seen_at(raster_of(*grid, points[f]))) < 1e-5);
  CHECK(all.counters.points_shaded == points.size());

  // Ten samples a pixel: the points of one triangle, then, in the next pixel, of the other.
  bucket.samples.samples_per_pixel = 20;
  bucket.samples.rect = {5, 7, 21, 8};
  const Run once = run(*pixel, bucket);
  CHECK(once.counters.points_shaded == 16);
  for (size_t f = 0; f < points.size(); ++f)
    CHECK(color_of(once.out, f) == color_of(all.out, f / 20 * 20));

  bucket.samples.samples_per_pixel = 1;
  bucket.samples.rect = {5, 7, 5 + int(points.size()), 8};
  CHECK(run(*pixel, bucket).counters.points_shaded == points.size());
}

TEST_CASE("reyes shades vertices and interpolates") {
  ModeScene test;
  const auto grid = test.colored_square(test.add_surface("constant"), 4);
  const auto points = inner_points(*grid, 4);
  const Run reyes = run(*make_shading("reyes", {test.bind()}), bucket_of(grid, points));
  CHECK(reyes.counters.points_shaded == 25);
  for (size_t f = 0; f < points.size(); ++f)
    CHECK(glm::length(color_of(reyes.out, f) - color_seen_at(raster_of(*grid, points[f]))) < 1e-5);
}

TEST_CASE("aas shades no more than ds, and as much where the blur promises nothing") {
  ModeScene test;
  test.scene.camera.shutter_close = 1;
  test.scene.camera.lens = CameraSettings::ThinLens{2, 0.4, 3};  // in focus at the square's depth
  const Surface& surface = test.add_surface("constant");
  const ShadingFrame frame{test.bind(), true, true};
  struct Motion {
    const char* what;
    std::function<glm::vec3(const glm::vec3&)> shift;
    bool saves;
  };
  const std::vector<Motion> motions = {
      {"none", [](const glm::vec3&) { return glm::vec3(0); }, false},
      {"a turn about the middle", [](const glm::vec3& P) { return glm::vec3(-P.y, P.x, 0); },
       false},
      {"growth from the middle", [](const glm::vec3& P) { return 0.5f * glm::vec3(P.x, P.y, 0); },
       false},
      {"towards the eye, through the focus", [](const glm::vec3&) { return glm::vec3(0, 0, -1); },
       false},
      {"to behind the eye", [](const glm::vec3&) { return glm::vec3(0, 0, -5); }, false},
      {"sideways", [](const glm::vec3&) { return glm::vec3(2, 0, 0); }, true},
      {"up and away", [](const glm::vec3&) { return glm::vec3(0, 3, 1); }, true}};
  for (const Motion& motion : motions) {
    const auto a = test.colored_square(surface, 16), b = test.colored_square(surface, 16);
    move(*a, motion.shift), move(*b, motion.shift);
    const auto points = inner_points(*a, 12);
    const auto aas =
        run(*make_shading("aas:share=0.95", frame), bucket_of(a, points)).counters.points_shaded;
    const auto ds = run(*make_shading("ds", frame), bucket_of(b, points)).counters.points_shaded;
    INFO(motion.what << " aas " << aas << " ds " << ds);
    CHECK(aas <= ds);
    CHECK(aas > 0);
    if (motion.saves) CHECK(double(aas) < 0.4 * double(ds));
    if (!motion.saves) CHECK(aas == ds);
  }
}

TEST_CASE("defocus widens cells in both directions") {
  ModeScene test;
  test.scene.camera.lens = CameraSettings::ThinLens{0.8, 0.4, 1};
  const Surface& surface = test.add_surface("constant");
  const ShadingFrame frame{test.bind(), false, true};
  const double coc = std::abs(double(test.camera->coc_raster(3.0f).x));
  const double d = 2 * test.camera->lens_profile().band_limit(0.95) / coc;
  INFO(d);
  REQUIRE(d < 0.5);
  REQUIRE(d > 0.2);
  const auto grid = test.colored_square(surface, 16);
  const Run aas =
      run(*make_shading("aas:lens=0.95", frame), bucket_of(grid, inner_points(*grid, 12)));
  const double side = std::ceil(raster_side * d);
  CHECK(double(aas.counters.points_shaded) == side * side);
}

TEST_CASE("requests name as many cells as are shaded") {
  ModeScene test;
  test.scene.camera.shutter_close = 1;
  const Surface& surface = test.add_surface("constant");
  const ShadingFrame frame{test.bind(), true, false};
  for (const char* mode : {"aas", "ds", "pixel", "sample"}) {
    const auto grid = test.colored_square(surface, 8);
    move(*grid, [](const glm::vec3&) { return glm::vec3(0.7f, 0.2f, 0); });
    const TestBucket bucket = bucket_of(grid, inner_points(*grid, 30));
    const auto shading = make_shading(mode, frame);
    std::set<uint64_t> points, quads;
    for (size_t f = 0; f < bucket.fragments.size(); ++f) {
      std::vector<ShadingRequest> requests;
      shading->requests(bucket.input(), f, requests);
      REQUIRE(requests.size() == 1);
      points.insert(requests[0].point), quads.insert(requests[0].quad);
    }
    const Run shaded = run(*shading, bucket);
    INFO(mode);
    CHECK(points.size() == shaded.counters.points_shaded);
    CHECK(quads.size() <= points.size());
    if (std::string_view(mode) == "ds") CHECK(double(quads.size()) < 0.4 * double(points.size()));
  }
}

TEST_CASE("a cell that fails is NaN, counted and blamed; its neighbours keep their bits") {
  for (const char* mode : {"aas", "ds", "pixel", "sample"}) {
    ModeScene test;
    const Surface& surface = test.add_surface("constant");
    const ShadingFrame frame{test.bind()};
    const auto good = test.colored_square(surface, 8), bad = test.colored_square(surface, 8);
    bad->primvars[0].values[40] = std::nanf("");  // red of the vertex in the middle
    const auto points = inner_points(*good, 6);
    const Run expected = run(*make_shading(mode, frame), bucket_of(good, points));
    const Run found = run(*make_shading(mode, frame), bucket_of(bad, points));
    INFO(mode);
    CHECK(expected.counters.nonfinite_dropped == 0);
    CHECK(found.counters.nonfinite_dropped > 0);
    CHECK(found.counters.points_shaded == expected.counters.points_shaded);
    size_t failed = 0, changed = 0, far = 0;
    for (size_t f = 0; f < points.size(); ++f) {
      const bool nan = std::isnan(found.out.Ci[0][f]);
      failed += nan;
      if (!nan)
        for (size_t c = 0; c < 3; ++c) changed += found.out.Ci[c][f] != expected.out.Ci[c][f];
      for (size_t c = 0; c < 3; ++c) changed += found.out.Oi[c][f] != 1.0f;
      // Micropolygons around the vertex reach 1/8 of the side; a cell, a pixel or so more.
      const glm::dvec2 off = glm::abs(raster_of(*good, points[f]) - 50.0);
      far += nan && std::max(off.x, off.y) > raster_side / 8 + 1.1;
    }
    CHECK(failed > 0);
    CHECK(failed < points.size() / 8);
    CHECK(changed == 0);
    CHECK(far == 0);
    const auto lines = test.diagnostics.lines();
    CHECK(std::ranges::count_if(lines, [](const std::string& line) {
            return line.find("\"constant\" gave values that are not finite") != std::string::npos;
          }) == 1);
  }
}

TEST_CASE("threads that ask for cells of the same grids get the same bits as one") {
  for (const char* mode : {"aas", "ds"}) {
    TestScene test;
    test.scene.camera.shutter_close = 1;
    test.add_light(call("pointlight", {number("intensity", 20.0f)}));
    const Surface &stone = test.add_surface("marble"), &board = test.add_surface("checker");
    const ShadingFrame frame{test.bind(), true, false};
    constexpr int buckets = 12;
    const auto shade_all = [&](int thread_count, uint64_t& points_shaded) {
      const auto shading = make_shading(mode, frame);
      std::vector<std::shared_ptr<const Grid>> grids;
      std::vector<std::vector<SurfacePoint>> points;
      for (uint32_t face = 0; face < 6; ++face) {
        const auto grid = make_square(face % 2 ? stone : board, 8, 2.0f + float(face), face);
        move(*grid, [&](const glm::vec3&) { return glm::vec3(0.3f * float(face), 0.1f, 0.2f); });
        grids.push_back(grid);
        points.push_back(inner_points(*grid, 3));
      }
      std::vector<ShadedFragments> results(buckets);
      std::vector<ShadeCounters> counters(size_t(thread_count), ShadeCounters{});
      std::vector<std::thread> threads;
      for (int t = 0; t < thread_count; ++t)
        threads.emplace_back([&, t] {
          for (int b = t; b < buckets; b += thread_count) {
            TestBucket bucket(400);
            bucket.grids = grids;
            for (size_t k = 0; k < 400; ++k) {
              const size_t g = (k + size_t(b)) % 6;
              const SurfacePoint& p = points[g][(k * 29 + size_t(b) * 101) % points[g].size()];
              bucket.add(uint32_t(g), p.triangle, p.b1, p.b2, 2.0f);
              bucket.finish_sample();
            }
            shading->shade(bucket.input(), results[size_t(b)], counters[size_t(t)]);
          }
        });
      for (std::thread& thread : threads) thread.join();
      points_shaded = 0;
      for (const ShadeCounters& c : counters) points_shaded += c.points_shaded;
      return results;
    };
    uint64_t alone_points = 0, points = 0;
    const auto alone = shade_all(1, alone_points);
    for (int round = 0; round < 3; ++round) {
      const auto together = shade_all(6, points);
      for (size_t b = 0; b < buckets; ++b) CHECK(together[b].Ci == alone[b].Ci);
      CHECK(points == alone_points);
    }
  }
}

TEST_CASE("a shader that throws ends every thread with its own reason") {
  struct Failing : TextureSampler {
    TextureResult sample(const TextureRequest&, const TexturePoints&, std::span<float>) override {
      std::this_thread::sleep_for(std::chrono::milliseconds(30));
      throw Error("the disc is on fire");
    }
  };
  TestScene test;
  test.add_light(call("ambientlight"));
  test.texture_sampler = [] { return std::make_shared<Failing>(); };
  const Surface& surface = test.add_surface("paintedplastic", {text("texturename", "st.tex")});
  const ShadingFrame frame{test.bind()};
  const auto shading = make_shading("ds", frame);
  const auto grid = make_square(surface, 8, 3.0f);
  const auto points = inner_points(*grid, 2);
  std::atomic<int> told = 0;
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&] {
      try {
        run(*shading, bucket_of(grid, points));
      } catch (const Error& error) {
        told += std::string(error.what()).find("the disc is on fire") != std::string::npos;
      }
    });
  for (std::thread& thread : threads) thread.join();
  CHECK(told == 4);
}
