#include <catch2/catch.hpp>

#include "reconstruct/pixel_facts.h"
#include "tests/reconstruct/distribution_frames.h"

using namespace tessera;
using namespace tessera::test;

namespace {

/// Weights below 0 to either side, as the best linear filters have them.
class RingingMethod : public GaussianMethod {
 public:
  RingingMethod() : GaussianMethod(false) {}
  void weights(const AxisWedge& wedge, float samples, float* out) const override {
    float wide[21];
    GaussianMethod::weights({2 * wedge.low, 2 * wedge.high}, samples, wide);
    GaussianMethod::weights(wedge, samples, out);
    for (int k = 0; k < 21; ++k) out[k] = 3 * out[k] - 2 * wide[k];
  }
};

/// A busy frame without and with bounces as bright as `fire` where `burns` says so.
struct FireflyImages {
  Image without, plain, with;

  FireflyImages(bool guarded, float fire, const std::function<bool(const SceneSample&)>& burns) {
    DistributionFrame frame = busy_frame(64, 64);
    frame.samples_per_pixel = 8;
    without = frame.render(gaussian(guarded));
    frame.shade = [=, shade = frame.shade](SceneSample& s) {
      shade(s);
      if (burns(s)) set(s.rays[1].received, fire), s.rays[1].slope = 1;
    };
    plain = frame.render(nullptr), with = frame.render(gaussian(guarded));
    CHECK(all_finite(with));
    CHECK(mean_of(with) == Approx(mean_of(plain)).epsilon(0.01));
  }
  float change(size_t p) const {
    return std::abs(with.channels[0].values[p] - without.channels[0].values[p]);
  }
};

bool lies_in(const SceneSample& s, int x, int y) {
  return s.x > float(x) && s.x < float(x + 1) && s.y > float(y) && s.y < float(y + 1);
}

}  // namespace

TEST_CASE("Fireflies stay where they are", "[reconstruction]") {
  const bool guarded = GENERATE(false, true);
  const float fire = GENERATE(1e5f, 1e30f);
  const FireflyImages images(
      guarded, fire, [](const SceneSample& s) { return lies_in(s, 30, 33) && s.t < 0.12f; });
  REQUIRE(mean_of(images.plain) > 1e-4 * fire / (64 * 64));  // it is there
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x)
      if (std::abs(x - 30) > 1 || std::abs(y - 33) > 1)
        REQUIRE(images.change(images.with.index(x, y)) < 0.2f);
}

TEST_CASE("Fireflies next to each other stay where they are, too", "[reconstruction]") {
  const bool guarded = GENERATE(false, true);
  // Three within the reach of one another, one of them in both halves of its samples.
  const FireflyImages images(guarded, 1e30f, [](const SceneSample& s) {
    return (lies_in(s, 30, 33) && s.t < 0.9f) ||
           ((lies_in(s, 33, 33) || lies_in(s, 31, 36)) && s.t < 0.12f);
  });
  size_t bright = 0;
  for (size_t p = 0; p < 64 * 64; ++p) {
    bright += images.plain.channels[0].values[p] > 1e20f;
    if (images.plain.channels[0].values[p] < 1e3f) REQUIRE(images.change(p) < 0.5f);
  }
  CHECK(bright > 3);
}

TEST_CASE("Filtered light is neither below 0 nor above what nothing blocks", "[reconstruction]") {
  DistributionFrame frame(96, 40);
  frame.settings.features.lens = frame.settings.features.shadow = true;
  const bool by_lens = GENERATE(false, true);
  frame.shade = [=](SceneSample& s) {
    const bool lit = s.x < 48 && !by_lens, near_edge = by_lens && s.x < 48;
    set(s.base, near_edge ? 1.0f : 0.0f);
    set(s.rays[0].unblocked, by_lens ? 0.0f : 1.0f), set(s.rays[0].received, lit ? 1.0f : 0.0f);
    s.rays[0].slope = 1, s.rays[0].extent[0] = s.rays[0].extent[1] = by_lens ? 0 : 5;
    s.coc[0] = s.coc[1] = by_lens ? 5 : 0;
  };
  const Image image = frame.render(std::make_unique<RingingMethod>());
  float least = 1, most = 0;
  for (const float value : image.channels[0].values)
    least = std::min(least, value), most = std::max(most, value);
  CHECK(least == 0);
  if (!by_lens) CHECK(most == 1);
  if (by_lens) CHECK(most < 1.6f);
}

TEST_CASE("Rare light in the dark is shared, not an outlier", "[reconstruction]") {
  DistributionFrame frame(60, 60);
  frame.settings.features.shadow = true;
  frame.shade = [](SceneSample& s) {
    const bool lit = s.x > 30 && s.x < 31 && s.y > 30 && s.y < 31;
    set(s.rays[0].unblocked, 1), set(s.rays[0].received, lit ? 1.0f : 0.0f);
    s.rays[0].slope = 1, s.rays[0].extent[0] = s.rays[0].extent[1] = 10;
  };
  frame.samples_per_pixel = 1;
  const Image plain = frame.render(nullptr), filtered = frame.render(gaussian(false));
  const size_t at = plain.index(30, 30);
  float most = 0;
  for (const float value : filtered.channels[0].values) most = std::max(most, value);
  REQUIRE(mean_of(plain) > 0);
  CHECK(most < 0.05f);
  CHECK(filtered.channels[0].values[at] > 0);
  CHECK(mean_of(filtered) == Approx(mean_of(plain)).epsilon(0.01));
}

TEST_CASE("Pixels whose samples drew no light have that of the others", "[reconstruction]") {
  // A light of which every other place faces away, blocked on the right.
  DistributionFrame frame(60, 60);
  frame.settings.features.shadow = frame.has_drawn = true;
  frame.samples_per_pixel = 1;
  frame.shade = [](SceneSample& s) {
    SceneSample::Ray& ray = s.rays[0];
    const float facing = ray.y[1] > 0 ? 1.0f : 0.0f;
    set(ray.unblocked, 0.5f), set(ray.drawn, facing), set(ray.received, s.x < 30 ? facing : 0.0f);
    ray.slope = 0.5f, ray.extent[0] = ray.extent[1] = 4;
  };
  const Image plain = frame.render(nullptr);
  for (const bool guarded : {false, true}) {
    const Image filtered = frame.render(gaussian(guarded));
    float least = 1;
    for (int y = 0; y < 60; ++y)
      for (int x = 0; x < 20; ++x)
        least = std::min(least, filtered.channels[0].values[filtered.index(x, y)]);
    CAPTURE(guarded);
    CHECK(least > 0.2f);
    CHECK(mean_of(filtered) == Approx(0.25).epsilon(0.05));
    CHECK(mean_of(plain) == Approx(0.25).epsilon(0.05));
  }
}

TEST_CASE("Pixels beyond floats are bounded and counted", "[reconstruction]") {
  const bool filtered = GENERATE(false, true);
  DistributionFrame frame(20, 20);
  frame.settings.features.lens = true;
  frame.settings.film.exposure_gain = 16;
  frame.shade = [](SceneSample& s) { set(s.base, s.x < 10 ? 5e37f : -5e37f); };
  FilmCounters counters;
  const Image image = frame.render(filtered ? gaussian() : nullptr, 0, 1, &counters);
  CHECK(counters.pixel_values_bounded == 3 * 20 * 20);
  constexpr float most = std::numeric_limits<float>::max();
  CHECK(image.channels[0].values[image.index(3, 3)] == most);
  CHECK(image.channels[2].values[image.index(15, 3)] == -most);
  CHECK(image.find_channel("Z")->values[image.index(3, 3)] == 1.0f);
}

TEST_CASE("Pixel filters whose weights cancel make no wild pixels", "[reconstruction]") {
  DistributionFrame frame = busy_frame(64, 64);
  frame.settings.film.filter = GENERATE("mitchell", "catmull-rom", "sinc");
  frame.settings.film.filter_x_width = frame.settings.film.filter_y_width = 4;
  frame.samples_per_pixel = 4;
  const auto shade = frame.shade;
  // Surfaces of a pixel and less, of which every other sends back much more light.
  frame.shade = [=](SceneSample& s) {
    shade(s);
    const bool bright = (int(s.x) + int(s.y)) % 2 == 0;
    for (auto& ray : s.rays)
      for (size_t c = 0; c < 3; ++c)
        ray.unblocked[c] *= bright ? 1.0f : 1e-3f, ray.received[c] *= bright ? 1.0f : 1e-3f;
  };
  const auto range_of = [](const Image& image) {
    const auto [least, most] = std::ranges::minmax(image.channels[0].values);
    return std::array{least, most};
  };
  const auto plain = range_of(frame.render(nullptr));
  for (const bool guarded : {false, true}) {
    const auto filtered = range_of(frame.render(gaussian(guarded)));
    CAPTURE(frame.settings.film.filter, guarded, plain[0], plain[1]);
    const float span = plain[1] - plain[0];
    CHECK(filtered[0] > plain[0] - 0.25f * span);
    CHECK(filtered[1] < plain[1] + 0.25f * span);
  }
}

TEST_CASE("Hard edges do not ring, and the other side is not shared", "[reconstruction]") {
  // A penumbra that ends at an edge where the surface turns: left lit half, right not at all.
  DistributionFrame frame(64, 32);
  frame.settings.features.shadow = true;
  frame.shade = [](SceneSample& s) {
    SceneSample::Ray& ray = s.rays[0];
    const bool left = s.x < 32;
    const bool lit = left ? ray.y[0] < 0 : false;
    set(ray.unblocked, 1), set(ray.received, lit ? 1.0f : 0.0f);
    s.N[0] = left ? 0.0f : 1.0f, s.N[2] = left ? 1.0f : 0.0f;
    ray.extent[0] = ray.extent[1] = 16;
    if (!lit) ray.slope = 0.5f;
  };
  const Image image = frame.render(gaussian(false));
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 64; ++x) {
      const float value = image.channels[0].values[image.index(x, y)];
      if (x < 32) REQUIRE(value == Approx(0.5).margin(0.3));
      if (x >= 32) REQUIRE(value == 0.0f);
    }
}

TEST_CASE("Degenerate frames give finite pixels", "[reconstruction]") {
  DistributionFrame frame = busy_frame(40, 30);
  const auto shade = frame.shade;
  SECTION("one sample a pixel") { frame.samples_per_pixel = 1; }
  SECTION("nothing seen") {
    frame.shade = [](SceneSample& s) { s.surface = 0, s.alpha = 0; };
    const Image image = frame.render(gaussian());
    CHECK(mean_of(image) == 0);
  }
  SECTION("no distance known") {
    frame.shade = [=](SceneSample& s) {
      shade(s);
      for (auto& ray : s.rays) ray.extent[0] = ray.extent[1] = 0;
    };
  }
  SECTION("infinite slopes, extents and shifts") {
    frame.shade = [=](SceneSample& s) {
      shade(s);
      s.rays[0].slope = inf, s.rays[1].extent[0] = inf, s.coc[0] = inf, s.velocity[1] = -inf;
    };
    PixelFacts facts(frame.settings.film.crop, frame.settings.features);
    facts.add(frame.bucket(frame.settings.film.crop), frame.settings.spreads);
    for (const WedgePlanes& wedges : facts.wedges)
      for (size_t p = 0; p < 1200; ++p)
        for (size_t a = 0; a < 2; ++a) {
          REQUIRE(std::abs(wedges.axis(a, p).low) <= PixelFacts::max_shift);
          REQUIRE(std::abs(wedges.axis(a, p).high) <= PixelFacts::max_shift);
        }
  }
  SECTION("huge slopes and shifts") {
    frame.shade = [=](SceneSample& s) {
      shade(s);
      s.rays[0].slope = 1e30f, s.rays[1].extent[0] = 1e30f, s.coc[0] = -1e30f;
      s.velocity[1] = 1e30f;
    };
  }
  SECTION("coordinates that are no numbers") {
    frame.shade = [=](SceneSample& s) {
      shade(s);
      s.rays[0].y[0] = s.u[1] = s.t = std::numeric_limits<float>::quiet_NaN();
    };
  }
  SECTION("huge light") {
    frame.shade = [=](SceneSample& s) {
      shade(s);
      for (auto& ray : s.rays) {
        for (float& value : ray.received) value *= 1e30f;
        for (float& value : ray.unblocked) value *= 1e30f;
      }
    };
  }
  SECTION("tiny light") {
    frame.shade = [=](SceneSample& s) {
      shade(s);
      for (auto& ray : s.rays) {
        for (float& value : ray.received) value *= 1e-38f;
        for (float& value : ray.unblocked) value *= 1e-38f;
      }
    };
  }
  CHECK(all_finite(frame.render(gaussian(true))));
  CHECK(all_finite(frame.render(gaussian(false))));
}

TEST_CASE("A frame cut short shows what arrived", "[reconstruction]") {
  const DistributionFrame frame = busy_frame(64, 48);
  const Image whole = frame.render(gaussian());
  ReconstructionSettings settings = frame.settings;
  settings.method = gaussian();
  const auto cut_short = make_reconstruction(settings);
  for (int b = 0; b < 9; ++b) {  // two of three rows of buckets, and one more
    const int x = 16 * (b % 4), y = 16 * (b / 4);
    cut_short->add_bucket(b % 4, b / 4, frame.bucket({x, y, x + 16, y + 16}));
  }
  const Image cut = cut_short->finish();
  CHECK(all_finite(cut));
  const int reach = reconstruction_reach(*gaussian()) + 1;
  for (int y = 0; y < 32 - reach; ++y)
    REQUIRE(cut.channels[0].values[cut.index(33, y)] ==
            whole.channels[0].values[whole.index(33, y)]);
  CHECK(cut.channels[0].values[cut.index(33, 28)] > 0.05f);
  CHECK(cut.channels[0].values[cut.index(40, 47)] == 0);
}

TEST_CASE("A sample that is not finite counts for nothing and is counted", "[reconstruction]") {
  DistributionFrame frame = busy_frame(40, 30);
  const auto shade = frame.shade;
  frame.shade = [=](SceneSample& s) {
    shade(s);
    if (s.x > 20 && s.x < 21 && s.y > 10 && s.y < 11 && s.t < 0.3f)
      s.rays[0].received[1] = std::numeric_limits<float>::quiet_NaN();
  };
  FilmCounters counters;
  CHECK(all_finite(frame.render(gaussian(), 0, 1, &counters)));
  CHECK(counters.nonfinite_samples_dropped > 0);
}
