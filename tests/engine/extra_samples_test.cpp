#include "engine/extra_samples.h"

#include <cmath>

#include <catch2/catch.hpp>

#include "reconstruct/sampling_rate.h"

using namespace tessera;

namespace {

Camera lens_camera() {
  CameraSettings settings;
  settings.x_resolution = 64, settings.y_resolution = 48;
  settings.lens = CameraSettings::ThinLens{2.0f, 0.4f, 5.0f};
  return Camera(settings);
}

/// Depths seen by the samples of a block, one fragment each; 0: the sample sees nothing.
FragmentList fragments_at(const std::vector<float>& depths) {
  FragmentList fragments;
  fragments.first_of_sample.push_back(0);
  for (size_t s = 0; s < depths.size(); ++s) {
    if (depths[s] > 0) {
      fragments.sample.push_back(uint32_t(s)), fragments.grid.push_back(0);
      fragments.triangle.push_back(uint32_t(7 * s));
      fragments.b1.push_back(0.25f), fragments.b2.push_back(0.5f);
      fragments.z.push_back(depths[s]), fragments.weight.push_back(0.5f);
    }
    fragments.first_of_sample.push_back(uint32_t(fragments.size()));
  }
  return fragments;
}

SampleBlock block_of(const PixelRect& rect, int samples_per_pixel) {
  SampleBlock block;
  block.rect = rect;
  block.samples_per_pixel = samples_per_pixel;
  return block;
}

/// Values that tell where they come from: `base` + the sample's place.
SampleValues values_of(const PixelRect& rect, int samples_per_pixel, float base) {
  SampleValues values;
  values.rect = rect;
  values.samples_per_pixel = samples_per_pixel;
  const size_t count = size_t(rect.pixel_count()) * size_t(samples_per_pixel);
  values.groups.resize(2);
  for (size_t s = 0; s < count; ++s) {
    const float value = base + float(s);
    values.x.push_back(value), values.y.push_back(-value);
    values.distribution.u.push_back(value);
    values.distribution.surfaces.surface.push_back(uint32_t(value));
  }
  for (int channel = 0; channel < 3; ++channel)
    for (size_t s = 0; s < count; ++s)
      values.groups[0].push_back(base + float(s) + 0.25f * float(channel));
  values.groups[1] = values.x;
  return values;
}

}  // namespace

TEST_CASE("Pixels that hold the focal plane get extra samples", "[extra_samples]") {
  const Camera camera = lens_camera();
  const ExtraPatterns patterns(100, 0, &camera.lens_profile(), nullptr, {});
  // Four pixels: before the focal plane, across it, nothing, behind it.
  const SampleBlock block = block_of({0, 0, 4, 1}, 2);
  const FragmentList fragments = fragments_at({2.0f, 2.5f, 1.0f, 9.0f, 0, 0, 6.0f, 9.0f});
  const auto chosen = choose_extra(block, fragments, camera, patterns);
  CHECK(chosen == std::vector<uint8_t>{0, chosen[1], 0, 0});
  REQUIRE(chosen[1] > 0);

  const float extent = camera.lens_profile().extent();
  const glm::vec2 a = extent * camera.coc_raster(1.0f), b = extent * camera.coc_raster(9.0f);
  const EffectWedges lens{{std::min(a.x, b.x), std::max(a.x, b.x)},
                          {std::min(a.y, b.y), std::max(a.y, b.y)}};
  const double wanted = std::min(100.0, samples_by_bound({&lens, 1}) - 2);
  const int given = patterns.pattern(chosen[1] - 1u).samples_per_pixel();
  CHECK(given >= wanted);
  CHECK((chosen[1] == 1 || patterns.pattern(chosen[1] - 2u).samples_per_pixel() < wanted));
}

TEST_CASE("Steps of extra samples end at the most allowed", "[extra_samples]") {
  for (const int most : {1, 7, 8, 9, 64, 100}) {
    CAPTURE(most);
    const ExtraPatterns patterns(most, 0, nullptr, nullptr, {});
    CHECK(patterns.pattern(patterns.steps() - 1).samples_per_pixel() == most);
    CHECK(patterns.step_for(1e9) == patterns.steps() - 1);
    CHECK(patterns.step_for(0) == 0);
    for (size_t step = 1; step < patterns.steps(); ++step)
      CHECK(patterns.pattern(step).samples_per_pixel() >
            patterns.pattern(step - 1).samples_per_pixel());
  }
}

TEST_CASE("Only fragments of the pixels chosen are kept", "[extra_samples]") {
  const PixelRect rect{10, 20, 13, 22};
  const std::vector<uint8_t> chosen{0, 2, 0, 1, 0, 2};
  CHECK(bounds_of(chosen, rect, 1) == PixelRect{10, 21, 11, 22});
  CHECK(bounds_of(chosen, rect, 2) == PixelRect{11, 20, 13, 22});
  CHECK(bounds_of(chosen, rect, 3).empty());

  const SampleBlock block = block_of(bounds_of(chosen, rect, 2), 2);
  FragmentList fragments = fragments_at({1, 1, 1, 1, 1, 1, 0, 1});
  keep_chosen(chosen, rect, 2, block, fragments);
  CHECK(fragments.sample == std::vector<uint32_t>{0, 1, 7});
  CHECK(fragments.triangle == std::vector<uint32_t>{0, 7, 49});
  CHECK(fragments.first_of_sample == std::vector<uint32_t>{0, 1, 2, 2, 2, 2, 2, 2, 3});
}

TEST_CASE("Extra samples join those of their pixels", "[extra_samples]") {
  const PixelRect rect{10, 20, 12, 22};
  const std::vector<uint8_t> chosen{0, 1, 2, 1};
  SampleValues values = values_of(rect, 2, 0);
  append_extra(chosen, 1, values_of({11, 20, 12, 22}, 3, 100), values);
  append_extra(chosen, 2, values_of({10, 21, 11, 22}, 1, 200), values);
  const std::vector<float> expected{0, 1, 2, 3, 100, 101, 102, 4, 5, 200, 6, 7, 103, 104, 105};
  CHECK(values.first_of_pixel == std::vector<uint32_t>{0, 2, 7, 10, 15});
  CHECK(values.x == expected);
  CHECK(values.groups[1] == expected);
  CHECK(values.distribution.u == expected);
  REQUIRE(values.groups[0].size() == 3 * expected.size());
  for (size_t s = 0; s < expected.size(); ++s) {
    CHECK(values.y[s] == -expected[s]);
    CHECK(values.distribution.surfaces.surface[s] == uint32_t(expected[s]));
    for (size_t c = 0; c < 3; ++c)
      CHECK(values.groups[0][c * expected.size() + s] == expected[s] + 0.25f * float(c));
  }
  CHECK(values.distribution.t.empty());
}

TEST_CASE("Effects that only one side has are nothing on the other", "[extra_samples]") {
  const PixelRect rect{0, 0, 2, 1};
  const std::vector<uint8_t> chosen{0, 1};
  const auto lit = [](SampleValues values, float base, bool drawn) {
    EffectValues& effect = values.distribution.effects[size_t(RayEffect::shadow)];
    effect.resize(values.x.size());
    if (drawn) effect.add_drawn();
    for (size_t s = 0; s < values.x.size(); ++s) {
      const float value = base + float(s);
      for (size_t c = 0; c < 3; ++c) {
        effect.received[c][s] = value, effect.unblocked[c][s] = 2 * value;
        if (drawn) effect.drawn[c][s] = 3 * value;
      }
      for (size_t a = 0; a < 2; ++a) effect.y[a][s] = 0.5f, effect.extent[a][s] = value;
      effect.slope[s] = value;
    }
    return values;
  };
  const auto own = [&] { return values_of(rect, 2, 0); };
  const auto more = [&] { return values_of({1, 0, 2, 1}, 2, 100); };
  for (const bool own_is_lit : {true, false}) {
    for (const bool drawn : {true, false}) {
      CAPTURE(own_is_lit, drawn);
      SampleValues values = own_is_lit ? lit(own(), 1, drawn) : own();
      append_extra(chosen, 1, own_is_lit ? more() : lit(more(), 1, drawn), values);
      const EffectValues& effect = values.distribution.effects[size_t(RayEffect::shadow)];
      const std::vector<float> expected =
          own_is_lit ? std::vector<float>{1, 2, 3, 4, 0, 0} : std::vector<float>{0, 0, 0, 0, 1, 2};
      CHECK(effect.received[1] == expected);
      CHECK(effect.extent[1] == expected);
      REQUIRE(effect.unblocked[2].size() == 6);
      REQUIRE(effect.slope.size() == 6);
      REQUIRE(effect.drawn[0].size() == (drawn ? 6u : 0u));
      for (size_t s = 0; s < 6; ++s) {
        const bool is_lit = expected[s] > 0;
        CHECK(effect.unblocked[2][s] == 2 * expected[s]);
        if (drawn) CHECK(effect.drawn[0][s] == 3 * expected[s]);
        CHECK(effect.y[0][s] == (is_lit ? 0.5f : 0.0f));
        CHECK(std::isnan(effect.slope[s]) == !is_lit);
      }
      CHECK(values.distribution.effects[size_t(RayEffect::bounce)].empty());
    }
  }
}
