#include <catch2/catch.hpp>

#include <cmath>

#include "shade/aov.h"
#include "tests/shade/fixtures.h"

using namespace tessera;
using namespace tessera::test;

namespace {

constexpr size_t shadow = size_t(RayEffect::shadow), bounce = size_t(RayEffect::bounce);

/// Three layers at depths 2, 4 and 6, all seen by sample 0; sample 1 sees nothing.
struct Layers {
  TestScene test;
  TestBucket bucket{2};
  ShadedFragments shaded;

  explicit Layers(bool matte_in_front = false, bool lens = false) {
    Attributes front;
    front.matte = matte_in_front;
    test.add_surface(front);
    test.add_surface(Attributes{});
    test.add_surface(Attributes{});
    if (lens) test.scene.camera.lens = CameraSettings::ThinLens{2.8, 0.5, 4.0};
    test.bind();
    for (uint32_t k = 0; k < 3; ++k) {
      bucket.grids.push_back(make_square(test.scene.surfaces[k], 1, 2.0f + 2.0f * float(k)));
      bucket.add(k, 0, 0.25f, 0.5f, 2.0f + 2.0f * float(k));
    }
    bucket.finish_sample();
    bucket.finish_sample();
    bucket.samples.u = {0.25f, -0.5f, 9.0f}, bucket.samples.v = {0.5f, 0.0f, 9.0f};
    bucket.samples.t = {0.0f, 0.75f, 9.0f};
    for (size_t c = 0; c < 3; ++c) {
      shaded.Ci[c] = {0.25f, 0.5f, 1.0f};
      shaded.Oi[c] = {0.5f, 0.75f, 1.0f};
    }
    for (EffectValues& effect : shaded.effects) effect.resize(3);
  }
  void light(size_t effect, size_t fragment, float unblocked, float received, float slope) {
    EffectValues& values = shaded.effects[effect];
    for (size_t c = 0; c < 3; ++c) {
      values.unblocked[c][fragment] = unblocked, values.received[c][fragment] = received;
    }
    values.y[0][fragment] = 0.125f * float(fragment + 1);
    values.y[1][fragment] = -0.125f * float(fragment + 1);
    values.extent[0][fragment] = 10.0f + float(fragment);
    values.extent[1][fragment] = 20.0f + float(fragment);
    values.slope[fragment] = slope;
  }
  DistributionSamples describe(bool lens = true, bool motion = true) {
    DistributionSamples out;
    describe_samples(bucket.input(), shaded, *test.camera, lens, motion, out);
    return out;
  }
  std::vector<float> group(const char* name) {
    std::vector<std::vector<float>> out;
    const AovDefinition* definition = &find_aov(name);
    composite(bucket.input(), shaded, *test.camera, {&definition, 1}, out);
    return out[0];
  }
};

}  // namespace

TEST_CASE("effects composite through what lies in front, as colour does") {
  Layers layers;
  layers.light(shadow, 1, 0.5f, 0.25f, 3.0f);
  layers.light(shadow, 2, 1.0f, 0.75f, 7.0f);
  const DistributionSamples out = layers.describe();
  const EffectValues& effect = out.effects[shadow];
  // Half passes the first layer, an eighth the first two.
  for (size_t c = 0; c < 3; ++c) {
    CHECK(effect.unblocked[c] == std::vector<float>{0.5f * 0.5f + 0.125f * 1.0f, 0.0f});
    CHECK(effect.received[c] == std::vector<float>{0.5f * 0.25f + 0.125f * 0.75f, 0.0f});
  }
  // The coordinates of the nearest fragment that the effect lights.
  CHECK(effect.y[0][0] == 0.25f);
  CHECK(effect.y[1][0] == -0.25f);
  CHECK(effect.extent[0][0] == 11.0f);
  CHECK(effect.extent[1][0] == 21.0f);
  CHECK(effect.slope[0] == 3.0f);
  CHECK(std::isnan(effect.slope[1]));
  CHECK(effect.extent[0][1] == 0.0f);
  CHECK(out.effects[bounce].unblocked[0] == std::vector<float>{0.0f, 0.0f});
}

TEST_CASE("light drawn from the samples' own places composites as unblocked light does") {
  Layers layers(true);  // half passes the first, which is matte
  CHECK(layers.describe().effects[shadow].drawn[0].empty());
  EffectValues& values = layers.shaded.effects[shadow];
  values.add_drawn();
  layers.light(shadow, 0, 0.5f, 0.25f, 3.0f);
  layers.light(shadow, 1, 0.5f, 0.25f, 3.0f);
  layers.light(shadow, 2, 1.0f, 0.75f, 7.0f);
  for (size_t c = 0; c < 3; ++c) values.drawn[c] = {9.0f, float(c + 1), 4.0f};
  DistributionSamples out = layers.describe();
  for (size_t c = 0; c < 3; ++c) {
    const float expected = 0.5f * float(c + 1) + 0.125f * 4.0f;
    CHECK(out.effects[shadow].drawn[c] == std::vector<float>{expected, 0.0f});
  }
  CHECK(out.effects[bounce].drawn[0].empty());
  values.drawn = values.unblocked;
  out = layers.describe();
  CHECK(out.effects[shadow].drawn == out.effects[shadow].unblocked);
}

TEST_CASE("matte surfaces hold effects out and bring none") {
  Layers layers(true);
  layers.light(shadow, 0, 1.0f, 1.0f, 1.0f);
  layers.light(shadow, 1, 0.5f, 0.25f, 3.0f);
  const DistributionSamples out = layers.describe();
  CHECK(out.effects[shadow].unblocked[1][0] == 0.5f * 0.5f);
  CHECK(out.effects[shadow].slope[0] == 3.0f);
  CHECK(out.surfaces.surface == std::vector<uint32_t>{0, 0});
}

TEST_CASE("effects that a frame does not have stay empty, and samples come without padding") {
  Layers layers;
  layers.shaded.effects[bounce].resize(0);
  DistributionSamples out = layers.describe();
  CHECK(out.effects[bounce].empty());
  CHECK(!out.effects[shadow].empty());
  CHECK(out.u == std::vector<float>{0.25f, -0.5f});
  CHECK(out.v == std::vector<float>{0.5f, 0.0f});
  CHECK(out.t == std::vector<float>{0.0f, 0.75f});
  out = layers.describe(false, false);
  CHECK(out.surfaces.coc[0].empty());
  CHECK(out.surfaces.velocity[1].empty());
}

TEST_CASE("direct and indirect light add up to the colour") {
  Layers layers;
  layers.light(bounce, 0, 0.5f, 0.1f, 1.0f);
  layers.light(bounce, 2, 0.5f, 0.3f, 1.0f);
  const auto rgb = layers.group("rgb"), direct = layers.group("direct");
  const auto indirect = layers.group("indirect");
  CHECK(indirect[0] == Approx(0.1 + 0.125 * 0.3));
  CHECK(indirect[1] == 0.0f);
  for (size_t k = 0; k < rgb.size(); ++k)
    CHECK(double(direct[k]) + double(indirect[k]) == Approx(rgb[k]).epsilon(1e-7));
  layers.shaded.effects[bounce].resize(0);
  CHECK(layers.group("direct") == rgb);
  CHECK(layers.group("indirect") == std::vector<float>(6, 0.0f));
}

TEST_CASE("the nearest surface is described: number, and the normal that faces the eye") {
  Layers layers;
  auto away = std::make_shared<Grid>();
  const Grid& front = *layers.bucket.grids[0];
  away->id = front.id, away->surface = front.surface, away->u_count = away->v_count = 1;
  away->P_camera = front.P_camera, away->uv = front.uv, away->st = front.st;
  for (const float n : front.N_camera) away->N_camera.push_back(-n);
  layers.bucket.grids[0] = away;
  const DistributionSamples out = layers.describe();
  CHECK(out.surfaces.surface == std::vector<uint32_t>{1, 0});
  CHECK(out.surfaces.N[2] == std::vector<float>{-1.0f, 0.0f});
  for (auto& opacity : layers.shaded.Oi) opacity[0] = 0.0f;
  CHECK(layers.describe().surfaces.surface[0] == 2);
}

TEST_CASE("a point is seen at its place through the lens centre plus coc times the lens place") {
  for (const float depth : {1.5f, 4.0f, 30.0f}) {
    Layers layers(false, true);
    layers.bucket.fragments.z[0] = depth;
    const DistributionSamples out = layers.describe();
    const glm::dvec2 coc(out.surfaces.coc[0][0], out.surfaces.coc[1][0]), at(30.0, 60.0);
    const Camera& camera = *layers.test.camera;
    const auto centre = camera.ray_camera(at, {0.0, 0.0});
    const glm::dvec3 P = centre.origin + double(depth) * centre.direction;
    for (const glm::dvec2 lens : {glm::dvec2(0.5, 0.0), glm::dvec2(-0.3, 0.8)}) {
      const auto ray = camera.ray_camera(at + coc * lens, lens);
      const glm::dvec3 met = ray.origin + double(depth) * ray.direction;
      CHECK(met.x == Approx(P.x).margin(1e-5));
      CHECK(met.y == Approx(P.y).margin(1e-5));
    }
    if (depth != 4.0f) CHECK(std::abs(coc.x) > 0.1);  // not in focus: the test says something
  }
}

TEST_CASE("velocity is the raster shift over the shutter, zero where it has none") {
  Layers layers;
  auto moving = make_square(layers.test.scene.surfaces[0], 1, 2.0f);
  add_key(*moving, 1.0f, [](const glm::vec3& P) { return P + glm::vec3(1, 0, 0); });
  layers.bucket.grids[0] = moving;
  // 100 pixels over 2 units at depth 1: one unit at depth 2 is 25.
  CHECK(layers.describe().surfaces.velocity[0][0] == Approx(25.0));
  CHECK(layers.describe().surfaces.velocity[1][0] == Approx(0.0).margin(1e-5));
  for (size_t k = 0; k < moving->stride(); ++k) moving->P(1, 2)[k] = 0.0f;
  CHECK(layers.describe().surfaces.velocity[0][0] == 0.0f);
}
