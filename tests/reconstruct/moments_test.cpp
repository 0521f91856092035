#include <catch2/catch.hpp>

#include "reconstruct/sample_moments.h"
#include "tests/reconstruct/distribution_scene.h"

using namespace tessera;
using namespace tessera::test;

namespace {

constexpr float nan_value = std::numeric_limits<float>::quiet_NaN();

/// Functions that tell every input of theirs apart.
class TellingMethod : public ReconstructionMethod {
 public:
  int basis_count() const override { return 2; }
  void basis(const BasisPoint& at, float* out) const override {
    out[0] = 1 + at.y + 10 * at.wedge.low + 100 * at.wedge.high;
    out[1] = at.second_y + 10 * at.second_wedge.low + 100 * at.second_wedge.high;
  }
  int degree(int k) const override { return k; }
  int max_degree() const override { return 2; }
  int reach() const override { return 1; }
  void weights(const AxisWedge&, float, float* out) const override { std::fill_n(out, 6, 1.0f); }
};

DistributionFrame frame_of(std::function<void(SceneSample&)> shade) {
  DistributionFrame frame(4, 3);
  frame.settings.features = {true, true, true, true};
  frame.has_drawn = true;
  frame.samples_per_pixel = 5;
  frame.shade = std::move(shade);
  return frame;
}

void shade_all(SceneSample& s) {
  for (size_t c = 0; c < 3; ++c) {
    s.base[c] = float(c) + s.x;
    for (size_t e = 0; e < 2; ++e) {
      s.rays[e].received[c] = 0.5f * float(e + 1) * s.y;
      s.rays[e].unblocked[c] = 2 + float(e);
    }
    s.rays[0].drawn[c] = 2 + s.x;
  }
  s.rays[0].slope = 0.1f * s.x, s.rays[0].extent[0] = 3, s.rays[0].extent[1] = 4;
  s.rays[1].slope = nan_value;
  s.coc[0] = 0.2f * s.y, s.coc[1] = -s.coc[0];
  s.velocity[0] = 3, s.velocity[1] = -1;
}

}  // namespace

TEST_CASE("Layouts count their planes, and products their channels", "[moments]") {
  const TellingMethod method;
  const MomentLayout layout({true, true, true, true}, method);
  CHECK(layout.value_count() == 3 + 1 + 9 + 6);
  // Pairs: all four of degree at most 2, and the two of time.
  CHECK(layout.carried_count() == 19 + 2 + 4 + 4 + 4 + 2);
  CHECK(layout.plane_count() == 2 * 19 + 4 * 6 + 4 * 6 + 4 * 19 + 2 * 19);
  CHECK(layout.drawn(RayEffect::shadow) == layout.received(RayEffect::shadow) + 3);
  CHECK(layout.unblocked(RayEffect::shadow) == layout.received(RayEffect::shadow) + 6);
  CHECK(layout.drawn(RayEffect::bounce) == layout.unblocked(RayEffect::bounce));
  CHECK(layout.unblocked(RayEffect::bounce) == layout.received(RayEffect::bounce) + 3);
  size_t products = 0;
  for (const SampleProducts& p : layout.products()) products += p.factor_count * p.value_count;
  CHECK(products == layout.plane_count());
  CHECK(MomentLayout({false, false, true, false}, method).stack(Blur::lens) == nullptr);
}

TEST_CASE("Carried channels are the samples' values and factors", "[moments]") {
  DistributionFrame frame = frame_of(shade_all);
  const SampleSpreads spreads{.lens = 2, .time = 0.25f};
  SampleValues values = frame.bucket({0, 0, 4, 3});
  const DistributionSamples d = values.distribution;
  const TellingMethod method;
  const MomentLayout layout(frame.settings.features, method);
  PixelFacts facts({0, 0, 4, 3}, frame.settings.features);
  facts.add(values, spreads);
  carry_moments(layout, facts, 0, spreads, values);
  const size_t n = values.x.size();
  const auto carried = [&](size_t c, size_t s) { return values.carried[c * n + s]; };
  for (size_t s = 0; s < n; ++s) {
    const size_t pixel = s / 5;
    CAPTURE(s);
    for (size_t c = 0; c < 3; ++c) {
      REQUIRE(carried(c, s) == Approx(float(c) + values.x[s]).margin(1e-5));
      REQUIRE(carried(layout.received(RayEffect::bounce) + c, s) == Approx(values.y[s]));
      REQUIRE(carried(layout.unblocked(RayEffect::shadow) + c, s) == 2);
      REQUIRE(carried(layout.drawn(RayEffect::shadow) + c, s) == 2 + values.x[s]);
      REQUIRE(carried(layout.unblocked(RayEffect::bounce) + c, s) == 3);
    }
    REQUIRE(carried(MomentLayout::one, s) == 1);
    REQUIRE(carried(layout.even_factor(), s) == (s % 5 % 2 == 0 ? 1 : 0));
    // Basis of the shadow: the raw wedges of the sample's own pixel.
    float low = 1e9f, high = -1e9f, lens_low = 1e9f, lens_high = -1e9f;
    for (size_t k = 5 * pixel; k < 5 * pixel + 5; ++k) {
      low = std::min(low, 0.1f * values.x[k] * 3), high = std::max(high, 0.1f * values.x[k] * 3);
      lens_low = std::min(lens_low, -0.2f * values.y[k] * spreads.lens);
      lens_high = std::max(lens_high, -0.2f * values.y[k] * spreads.lens);
    }
    const MomentStack& stack = *layout.stack(Blur::shadow);
    REQUIRE(stack.pairs[2].j == 1);
    REQUIRE(stack.pairs[2].k == 0);
    const double bx1 = d.u[s] / 2 + 10 * lens_low + 100 * lens_high;
    const double by0 = 1 + d.effects[0].y[1][s] + 10 * low * 4 / 3 + 100 * high * 4 / 3;
    REQUIRE(carried(stack.first_factor + 2, s) == Approx(bx1 * by0).epsilon(1e-4));
    // Time: one axis, y = 4 t - 2; everything moves by -v/4 per unit of it.
    const MomentStack& motion = *layout.stack(Blur::motion);
    const double shift = 0.25 * std::hypot(3.0, 1.0);
    REQUIRE(carried(motion.first_factor, s) ==
            Approx(1 + 4 * d.t[s] - 2 + 110 * shift).epsilon(1e-5));
    // Nothing is known of the bounce, so its wedge is {0, 0}.
    REQUIRE(carried(layout.stack(Blur::bounce)->first_factor, s) ==
            Approx((1 + d.effects[1].y[0][s]) * (1 + d.effects[1].y[1][s])).margin(1e-5));
  }
}

TEST_CASE("Without light of its own places a shadow is drawn from what is unblocked", "[moments]") {
  DistributionFrame frame = frame_of(shade_all);
  frame.has_drawn = false;
  SampleValues values = frame.bucket({0, 0, 4, 3});
  const TellingMethod method;
  const MomentLayout layout(frame.settings.features, method);
  const PixelFacts facts({0, 0, 4, 3}, frame.settings.features);
  carry_moments(layout, facts, 0, {}, values);
  const size_t n = values.x.size();
  for (size_t i = 0; i < 3 * n; ++i)
    REQUIRE(values.carried[layout.drawn(RayEffect::shadow) * n + i] == 2);
}

TEST_CASE("Every stack carries the functions of its own method", "[moments]") {
  const auto wiener = make_method("wiener", reconstruction_method_registry());
  const MomentLayout layout({true, true, true, true}, *wiener);
  CHECK(layout.stack(Blur::bounce)->method == &wiener->for_bounces());
  CHECK(layout.stack(Blur::bounce)->pairs.size() == 1);
  for (const Blur blur : {Blur::shadow, Blur::lens, Blur::motion})
    CHECK(layout.stack(blur)->method == wiener.get());
  CHECK(layout.stack(Blur::shadow)->pairs.size() == 6);  // of three functions, degree at most 2
  CHECK(layout.stack(Blur::motion)->pairs.size() == 3);
}

TEST_CASE("Coordinates that are no numbers count as the middle, infinite ones as the farthest",
          "[moments]") {
  DistributionFrame frame = frame_of([](SceneSample& s) {
    s.rays[0].y[0] = nan_value, s.rays[0].y[1] = std::numeric_limits<float>::infinity();
  });
  SampleValues values = frame.bucket({0, 0, 4, 3});
  const TellingMethod method;
  const MomentLayout layout(frame.settings.features, method);
  const PixelFacts facts({0, 0, 4, 3}, frame.settings.features);
  carry_moments(layout, facts, 0, {}, values);
  const size_t factor = layout.stack(Blur::shadow)->first_factor;
  for (size_t s = 0; s < values.x.size(); ++s)
    REQUIRE(values.carried[factor * values.x.size() + s] == 3);  // (1 + 0) (1 + 2)
}

TEST_CASE("Facts: wedges, normals and surfaces of a pixel's samples", "[moments]") {
  DistributionFrame frame = frame_of([](SceneSample& s) {
    const int k = int(s.t * 1e6f) % 3;
    s.rays[0].slope = s.x < 1 ? nan_value : 0.5f + 0.5f * s.u[0];
    s.rays[0].extent[0] = 2, s.rays[0].extent[1] = s.x < 2 ? 0 : 6;
    s.surface = s.y < 1 ? 0 : k == 0 ? 7 : 9;
    s.coc[0] = s.coc[1] = 3, s.N[0] = 0.6f, s.N[2] = 0.8f;
  });
  const SampleValues values = frame.bucket({0, 0, 4, 3});
  PixelFacts facts({0, 0, 4, 3}, frame.settings.features);
  facts.add(values, {.lens = 2});
  const WedgePlanes& shadow = facts.wedges[size_t(Blur::shadow)];
  const WedgePlanes& lens = facts.wedges[size_t(Blur::lens)];
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 4; ++x) {
      const size_t p = facts.index(x, y);
      REQUIRE(facts.samples[p] == 5);
      REQUIRE(shadow.known(p) == (x >= 1));
      REQUIRE(lens.known(p) == (y >= 1));
      CHECK(facts.N[0][p] == Approx(y >= 1 ? 0.6 : 0));
      if (y >= 1) CHECK(lens.axis(1, p).low == -6);
      if (x < 1) continue;
      float least = 1e9f, most = 0;
      for (size_t s = 5 * p; s < 5 * p + 5; ++s) {
        least = std::min(least, values.distribution.effects[0].slope[s]);
        most = std::max(most, values.distribution.effects[0].slope[s]);
      }
      CHECK(shadow.axis(0, p).low == Approx(2 * least));
      CHECK(shadow.axis(0, p).high == Approx(2 * most));
      CHECK(shadow.axis(1, p).high == Approx(x < 2 ? 0 : 6 * most));
      int nines = 0;
      for (size_t s = 5 * p; s < 5 * p + 5; ++s)
        nines += values.distribution.surfaces.surface[s] == 9;
      if (y >= 1) CHECK(facts.surface[p] == (nines >= 3 ? 9 : 7));
    }
  }
}

TEST_CASE("Smoothing averages lows and highs of one surface", "[moments]") {
  const PixelRect rect{0, 0, 12, 9};
  DistributionFeatures features;
  features.shadow = features.lens = true;
  PixelFacts facts(rect, features);
  for (int y = 0; y < 9; ++y)
    for (int x = 0; x < 12; ++x) {
      const size_t p = facts.index(x, y);
      facts.surface[p] = x < 6 ? 1 : 2;
      if (y == 4) continue;  // nothing known in this row
      for (const Blur blur : {Blur::shadow, Blur::lens}) {
        WedgePlanes& w = facts.wedges[size_t(blur)];
        w.low[0][p] = float(x), w.high[0][p] = float(x + y), w.low[1][p] = w.high[1][p] = 1;
      }
    }
  const PixelFacts smooth = smoothed(facts, rect.grown(-1));
  const auto at = [&](Blur blur, int x, int y) {
    return smooth.wedges[size_t(blur)].axis(0, smooth.index(x, y));
  };
  CHECK(smooth.rect() == rect.grown(-1));
  CHECK(at(Blur::lens, 5, 4).low == Approx(5));
  CHECK(at(Blur::lens, 5, 4).high == Approx(5 + 4));      // rows 2, 3, 5, 6
  CHECK(at(Blur::shadow, 5, 4).low == Approx(4));         // columns 3, 4, 5
  CHECK(at(Blur::shadow, 6, 2).low == Approx(7));         // columns 6, 7, 8
  CHECK(at(Blur::shadow, 6, 2).high == Approx(7 + 1.5));  // rows 0, 1, 2, 3
  CHECK(smooth.wedges[size_t(Blur::lens)].sure_shift(smooth.index(5, 3)) ==
        Approx(std::hypot(5.0, 1.0)));
}

TEST_CASE("A wedge that holds 0 is no sure shift", "[moments]") {
  DistributionFeatures features;
  features.lens = true;
  PixelFacts facts({0, 0, 2, 1}, features);
  WedgePlanes& lens = facts.wedges[size_t(Blur::lens)];
  CHECK(lens.sure_shift(0) == 0);
  lens.low[0][0] = -3, lens.high[0][0] = 2, lens.low[1][0] = -5, lens.high[1][0] = -4;
  CHECK(lens.sure_shift(0) == 4);
}
