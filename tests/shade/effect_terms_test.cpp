#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "hide/samples.h"
#include "shade/light_terms.h"
#include "shade/sample_places.h"
#include "tests/shade/bounce_fixtures.h"

using namespace tessera;
using namespace tessera::test;

namespace {

constexpr size_t bounce = size_t(RayEffect::bounce), shadow = size_t(RayEffect::shadow);

/// A white floor in the plane z = 3 of which x > 0 is seen, with a wall along the eye's axis that
/// covers part of its sky, under an occlusion light.
struct Yard {
  TestScene test;
  std::shared_ptr<ShaderBindings> bindings;
  std::shared_ptr<const RayTracer> tracer;

  explicit Yard(std::vector<ShaderCall> lights, const std::string& shader = "matte") {
    for (ShaderCall& light : lights) test.add_light(std::move(light));
    test.add_surface(shader);
    test.add_surface("matte");
    test.camera = std::make_unique<Camera>(test.scene.camera);
    bindings = bind_shaders({&test.scene, test.camera.get(), &test.diagnostics, {}});
    // At x = 0.5, 1 to both sides and 2 high, towards the eye.
    tracer = std::make_shared<BruteTracer>(std::vector<std::shared_ptr<const Grid>>{
        make_square(floor(), 1, 3.0f), make_grid(wall(), 1, 1, [](float u, float v) {
          return glm::vec3(0.5f, 2.0f * u - 1.0f, 3.0f - 2.0f * v);
        })});
    use_rays(*bindings, tracer);
  }
  const Surface& floor() const { return test.scene.surfaces[0]; }
  const Surface& wall() const { return test.scene.surfaces[1]; }
};

/// Pixels whose samples all see the middle of a floor's triangle: (1/3, -1/3, 3) of make_square().
TestBucket bucket_of(const Surface& surface, const PixelRect& rect, int spp) {
  TestBucket bucket(0);
  SamplePattern(spp, 3, nullptr, nullptr, {}, {true, true}).fill(rect, bucket.samples);
  bucket.grids = {make_square(surface, 1, 3.0f)};
  for (size_t s = 0; s < bucket.samples.size(); ++s) {
    bucket.add(0, 0, 1.0f / 3.0f, 1.0f / 3.0f, 3.0f);
    bucket.finish_sample();
  }
  return bucket;
}

struct Shaded {
  ShadedFragments fragments;
  ShadeCounters counters;
};
Shaded shade(const Yard& yard, const TestBucket& bucket, const char* mode = "reyes") {
  Shaded result;
  make_shading(mode, {yard.bindings})->shade(bucket.input(), result.fragments, result.counters);
  return result;
}

double mean(const std::vector<float>& values) {
  double sum = 0;
  for (const float v : values) sum += double(v);
  return sum / double(values.size());
}

/// What the wall leaves open of the sky over the point that samples see.
double open_share() {
  const double d = 0.5 - 1.0 / 3.0;
  return 1.0 - upright_rectangle(d, 1 - 1.0 / 3.0, 2) - upright_rectangle(d, 1 + 1.0 / 3.0, 2);
}

}  // namespace

TEST_CASE("samples' own rays average to the configuration factor, in every shading mode") {
  for (const char* mode : {"reyes", "ds", "aas", "pixel", "sample"}) {
    INFO(mode);
    const Yard yard({call("occlusionlight", {number("intensity", 2.0f)})});
    const TestBucket bucket = bucket_of(yard.floor(), {10, 20, 18, 28}, 16);
    const Shaded shaded = shade(yard, bucket, mode);
    const EffectValues& effect = shaded.fragments.effects[bounce];
    REQUIRE(effect.slope.size() == bucket.fragments.size());
    CHECK(shaded.fragments.effects[shadow].empty());
    CHECK(mean(effect.received[0]) == Approx(2.0 * open_share()).margin(0.01));
    CHECK(mean(effect.unblocked[1]) == Approx(2.0));
    CHECK(shaded.fragments.Ci == effect.received);
    CHECK(shaded.counters.rays == bucket.fragments.size());
    CHECK(shaded.counters.shadow_lookups == 0);
    for (size_t f = 0; f < effect.slope.size(); ++f)
      REQUIRE(std::isnan(effect.slope[f]) == (effect.received[0][f] == 2.0f));
    // A pixel of 16 samples is far nearer than 16 independent ones: their deviation is that of a
    // choice between two, over four.
    const double open = open_share(), independent = 2.0 * std::sqrt(open * (1 - open) / 16);
    double square = 0;
    for (size_t first = 0; first < effect.slope.size(); first += 16) {
      double sum = 0;
      for (size_t k = 0; k < 16; ++k) sum += double(effect.received[0][first + k]) / 16;
      square += (sum - 2.0 * open) * (sum - 2.0 * open) / 64;
    }
    CHECK(std::sqrt(square) < 0.6 * independent);
  }
}

TEST_CASE("what is drawn is what the sample's own place sends, whatever is in its way") {
  // Rectangles of 2 x 1 at depth 1 that shine towards the floor, seen by samples at one point.
  const auto lamp = [](double x, float intensity) {
    return call("rectanglelight", {number("width", 2), number("intensity", intensity)},
                glm::translate(glm::dmat4(1.0), glm::dvec3(x, 0.25, 1.0)));
  };
  const auto sent = [](double x, double intensity, const glm::vec2& xi) {
    const glm::dvec3 place(x + 2.0 * double(xi.x) - 1.0, 0.25 + double(xi.y) - 0.5, 1.0);
    const glm::dvec3 to = place - glm::dvec3(1.0 / 3.0, -1.0 / 3.0, 3.0);
    const double d2 = glm::dot(to, to);
    return intensity * 2.0 * to.z * to.z / (d2 * d2) / 3.14159265358979;
  };
  const Yard yard({lamp(1.0, 1.0f), call("occlusionlight"), lamp(-0.5, 3.0f)});
  TestBucket bucket = bucket_of(yard.floor(), {0, 0, 6, 6}, 16);
  bucket.grids = {make_square(yard.floor(), 30, 3.0f)};  // with a vertex at that point
  std::ranges::fill(bucket.fragments.triangle, 2 * (10 * 30 + 20));
  std::ranges::fill(bucket.fragments.b1, 0.0f), std::ranges::fill(bucket.fragments.b2, 0.0f);
  const SamplePlaces first(bucket.samples, RayEffect::shadow, 0),
      second(bucket.samples, RayEffect::shadow, 1);
  const Shaded shaded = shade(yard, bucket);
  const EffectValues& effect = shaded.fragments.effects[shadow];
  CHECK(shaded.fragments.effects[bounce].drawn[0].empty());
  REQUIRE(effect.drawn[2].size() == bucket.fragments.size());
  int dark = 0, partly = 0, bright = 0;
  for (uint32_t f = 0; f < bucket.fragments.size(); ++f) {
    const double a = sent(1.0, 1.0, first.of_sample(f)), b = sent(-0.5, 3.0, second.of_sample(f));
    REQUIRE(effect.drawn[0][f] == Approx(a + b).epsilon(1e-4));
    REQUIRE(effect.unblocked[0][f] == effect.unblocked[0][0]);
    const double received = effect.received[0][f];
    const bool has_a = received > 0.5 * a, has_b = received > 0.5 * b;
    REQUIRE(received <= double(effect.drawn[0][f]));
    dark += !has_a && !has_b, bright += received == double(effect.drawn[0][f]);
    partly += received > 0 && received < 0.999 * double(effect.drawn[0][f]);
  }
  // The wall hides some places of the light beyond it, none of the other.
  CHECK(bright > 20);
  CHECK(partly > 20);
  CHECK(dark == 0);
  CHECK(mean(effect.drawn[0]) == Approx(mean(effect.unblocked[0])).epsilon(5e-3));
}

TEST_CASE("what is drawn is the share that is open times the term") {
  const Yard yard({call("disclight", {number("radius", 0.8f)},
                        glm::translate(glm::dmat4(1.0), glm::dvec3(0.5, 0.0, 2.0)))},
                  "plastic");
  CHECK(yard.bindings->light_term_count() == 2);  // and its mean over the places
  const TestBucket bucket = bucket_of(yard.floor(), {0, 0, 4, 4}, 16);
  const Shaded shaded = shade(yard, bucket);
  const BoundLight& light = *yard.bindings->term_lights()[0];
  REQUIRE((light.term && light.mean_term));
  const SamplePlaces places(bucket.samples, RayEffect::shadow, 0);
  LightServices services = yard.bindings->light_services();
  ShadeCounters counters;
  services.counters = &counters;
  const auto& term = shaded.fragments.light_terms[*light.term];
  const auto& mean_term = shaded.fragments.light_terms[*light.mean_term];
  const EffectValues& effect = shaded.fragments.effects[shadow];
  float least = 1e9f, most = 0;
  for (uint32_t f = 0; f < bucket.fragments.size(); ++f) {
    const LightPoints at({{1.0f / 3.0f, -1.0f / 3.0f, 3.0f}}, {0, 0, -1}, yard.floor().id);
    Vec3Array mean_received(1);
    for (int c = 0; c < 3; ++c) mean_received.component(c)[0] = mean_term[size_t(c)][f];
    services.mean_received = &mean_received;
    ShareSamples found;
    found.reset(1);
    const std::vector<glm::vec2> xi{places.of_sample(f)};
    light.definition->share_from(light, at.points, xi, services, found);
    least = std::min(least, found.open[0].x), most = std::max(most, found.open[0].x);
    for (size_t c = 0; c < 3; ++c) {
      const int channel = int(c);
      REQUIRE(effect.unblocked[c][f] == term[c][f]);
      REQUIRE(effect.drawn[c][f] == Approx(found.open[0][channel] * term[c][f]).epsilon(1e-4));
      REQUIRE(effect.received[c][f] == Approx(found.share[0][channel] * term[c][f]).epsilon(1e-4));
    }
  }
  CHECK(most > 1.5f * least);  // the places differ
}

TEST_CASE("what samples find does not depend on the bucket") {
  const Yard yard({call("occlusionlight"), call("occlusionlight"), call("indirectlight")});
  const Shaded whole = shade(yard, bucket_of(yard.floor(), {4, 4, 12, 12}, 8));
  const Shaded part = shade(yard, bucket_of(yard.floor(), {6, 7, 9, 10}, 8));
  const auto& all = whole.fragments.effects[bounce];
  const auto& some = part.fragments.effects[bounce];
  for (size_t y = 0; y < 3; ++y)
    for (size_t x = 0; x < 3; ++x)
      for (size_t k = 0; k < 8; ++k) {
        const size_t a = ((y + 3) * 8 + x + 2) * 8 + k, b = (y * 3 + x) * 8 + k;
        REQUIRE(all.received[0][a] == some.received[0][b]);
        REQUIRE(whole.fragments.Ci[2][a] == part.fragments.Ci[2][b]);
        REQUIRE(all.y[0][a] == some.y[0][b]);
      }
}

TEST_CASE("more than a batch of samples, and all that is seen of a grid in a pixel at pixel rate") {
  const auto at_rate = [](const char* rate) {
    return call("occlusionlight", {text("shadowrate", rate)});
  };
  const Yard fine({at_rate("sample")}), coarse({at_rate("pixel")}), none({at_rate("cell")});
  const TestBucket bucket = bucket_of(fine.floor(), {0, 0, 20, 16}, 8);
  const Shaded samples = shade(fine, bucket);
  TestBucket same = bucket;
  same.grids = {make_square(coarse.floor(), 1, 3.0f)};
  const Shaded pixels = shade(coarse, same);
  same.grids = {make_square(none.floor(), 1, 3.0f)};
  CHECK(shade(none, same).fragments.effects[bounce].empty());
  CHECK(samples.counters.rays == 20 * 16 * 8);
  CHECK(pixels.counters.rays == 20 * 16);
  const auto off_centre = [&](size_t s) {
    const double dx = std::fmod(double(bucket.samples.x[s]), 1.0) - 0.5;
    const double dy = std::fmod(double(bucket.samples.y[s]), 1.0) - 0.5;
    return dx * dx + dy * dy;
  };
  for (size_t first = 0; first < bucket.samples.size(); first += 8) {
    size_t middle = first;
    for (size_t s = first; s < first + 8; ++s)
      if (off_centre(s) < off_centre(middle)) middle = s;
    for (size_t s = first; s < first + 8; ++s)
      REQUIRE(pixels.fragments.Ci[0][s] == samples.fragments.Ci[0][middle]);
  }
}

TEST_CASE("lights of an effect add up, and the brighter one has the coordinate") {
  const auto lamp = [](float intensity, float reach) {
    return call("occlusionlight", {number("intensity", intensity), number("maxdistance", reach)});
  };
  // The second of each is the first alone, but with places of its own.
  const Yard both({lamp(1.0f, 1e30f), lamp(3.0f, 0.0f)}),
      other({lamp(3.0f, 1e30f), lamp(1.0f, 0.0f)});
  const TestBucket bucket = bucket_of(both.floor(), {0, 0, 4, 4}, 16);
  TestBucket same = bucket;
  same.grids = {make_square(other.floor(), 1, 3.0f)};
  const Shaded a = shade(both, bucket), b = shade(other, same);
  for (size_t f = 0; f < bucket.fragments.size(); ++f) {
    const float met_a = 4.0f - a.fragments.Ci[0][f], met_b = (4.0f - b.fragments.Ci[0][f]) / 3.0f;
    REQUIRE(met_a == Approx(met_b).margin(1e-6));
    REQUIRE(a.fragments.effects[bounce].unblocked[2][f] == 4.0f);
    REQUIRE(std::isnan(a.fragments.effects[bounce].slope[f]));
    REQUIRE(std::isnan(b.fragments.effects[bounce].slope[f]) == (met_b == 0.0f));
  }
}

TEST_CASE(
    "surfaces that an effect does not light cost no rays, and samples without places are told") {
  const Yard dark({call("occlusionlight", {number("intensity", 0.0f)})});
  const Shaded shaded = shade(dark, bucket_of(dark.floor(), {0, 0, 4, 4}, 4));
  CHECK(shaded.counters.rays == 0);
  CHECK(shaded.fragments.effects[bounce].slope.size() == 64);
  const Yard yard({call("occlusionlight")});
  TestBucket bucket = bucket_of(yard.floor(), {0, 0, 4, 4}, 4);
  bucket.samples.bounce_y.clear();
  CHECK_THROWS_WITH(shade(yard, bucket), Catch::Contains("SampleExtras"));
}

TEST_CASE("a share that is not a number brings nothing, and is counted") {
  class FailingTracer : public BruteTracer {
   public:
    using BruteTracer::BruteTracer;
    void shadow(const Rays& rays, RayShadows& shadows) const override {
      BruteTracer::shadow(rays, shadows);
      for (size_t i = 0; i < shadows.share.size(); i += 2) shadows.share[i] = std::nanf("");
    }
  };
  Yard yard({call("occlusionlight")});
  use_rays(*yard.bindings,
           std::make_shared<FailingTracer>(std::vector<std::shared_ptr<const Grid>>{}));
  const Shaded shaded = shade(yard, bucket_of(yard.floor(), {0, 0, 2, 2}, 4));
  for (size_t f = 0; f < 16; ++f) CHECK(shaded.fragments.Ci[0][f] == (f % 2 == 0 ? 0.0f : 1.0f));
  CHECK(shaded.counters.nonfinite_dropped == 8);
}

TEST_CASE("what moves is met where it was when the sample was taken") {
  Yard yard({call("occlusionlight")});
  // A lid close over the whole floor, which slides away in the first half of the shutter: it is as
  // wide as 200 and moves by 400.
  auto lid = make_grid(yard.wall(), 1, 1, [](float u, float v) {
    return glm::vec3(200.0f * u - 100.0f, 200.0f * v - 100.0f, 2.99f);
  });
  add_key(*lid, 1.0f, [](const glm::vec3& P) { return P + glm::vec3(400, 0, 0); });
  use_rays(*yard.bindings,
           std::make_shared<BruteTracer>(std::vector<std::shared_ptr<const Grid>>{lid}));
  TestBucket bucket = bucket_of(yard.floor(), {0, 0, 4, 4}, 4);
  for (size_t s = 0; s < bucket.samples.size(); ++s)
    bucket.samples.t.push_back(s % 2 == 0 ? 0.2f : 0.3f);
  const Shaded shaded = shade(yard, bucket);
  // At 0.2 the lid's edge is at x = -20, at 0.3 at x = 20; the floor point sees all but grazing
  // directions through a hundredth over it.
  int early = 0, late = 0;
  for (size_t s = 0; s < bucket.samples.size(); ++s)
    (s % 2 == 0 ? early : late) += shaded.fragments.Ci[0][s] == 0.0f;
  CHECK(early == 32);
  CHECK(late == 0);
}
