#include <catch2/catch.hpp>

#include <bit>

#include "base/error.h"
#include "reconstruct/pixel_facts.h"
#include "tests/reconstruct/distribution_scene.h"

using namespace tessera;
using namespace tessera::test;

namespace {

constexpr float inf = std::numeric_limits<float>::infinity();

float checks(float x, float y) { return (int(x) / 3 + int(y) / 3) % 2 ? 1.0f : 0.3f; }

void set(float (&channels)[3], float value) {
  for (float& channel : channels) channel = value;
}

/// The penumbra of a straight edge, `half_width` pixels to either side of `edge`, over checks.
void shade_penumbra(SceneSample& s, float edge, float half_width) {
  SceneSample::Ray& ray = s.rays[0];
  const bool lit = s.x + half_width * ray.y[0] < edge;
  set(s.base, 0.1f);
  set(ray.unblocked, checks(s.x, s.y));
  set(ray.received, lit ? checks(s.x, s.y) : 0.0f);
  ray.extent[0] = ray.extent[1] = 2 * half_width;
  if (!lit) ray.slope = 0.5f;
}
double penumbra_truth(int x, int y, double edge, double half_width) {
  return 0.1 + mean_ramp(edge - (x + 0.5), half_width) * checks(float(x), float(y));
}
DistributionFrame penumbra_frame(int width = 96, int height = 48) {
  DistributionFrame frame(width, height);
  frame.settings.features.shadow = true;
  frame.shade = [](SceneSample& s) { shade_penumbra(s, 48, 12); };
  return frame;
}

/// Everything at once: a penumbra and a bounce on surfaces that are out of focus and move.
DistributionFrame busy_frame(int width, int height) {
  DistributionFrame frame(width, height);
  frame.settings.features = {true, true, true, true};
  frame.settings.film.filter = "gaussian";
  frame.settings.film.filter_x_width = frame.settings.film.filter_y_width = 2;
  frame.shade = [](SceneSample& s) {
    shade_penumbra(s, 40, 6);
    s.coc[0] = s.coc[1] = 0.1f * s.y + 0.04f * s.x, s.velocity[0] = 0.2f * s.x, s.velocity[1] = 3;
    SceneSample::Ray& ray = s.rays[1];
    set(ray.unblocked, 0.5f);
    set(ray.received, 0.25f + 0.25f * std::sin(0.3f * (s.x + 8 * ray.y[0])));
    ray.slope = s.y < 10 ? std::numeric_limits<float>::quiet_NaN() : 1;
    ray.extent[0] = 8 + 0.05f * s.x, ray.extent[1] = 6;
    s.surface = s.x - 0.1f * s.y * s.u[0] < 50 ? 1 : 2;
    s.N[0] = s.surface == 2 ? 0.8f : 0.0f, s.N[2] = s.surface == 2 ? 0.6f : 1.0f;
  };
  return frame;
}

bool same_pixels(const Image& part, const Image& whole) {
  if (part.channels.size() != whole.channels.size()) return false;
  const PixelRect& r = part.data_window;
  for (size_t c = 0; c < part.channels.size(); ++c)
    for (int y = r.y0; y < r.y1; ++y)
      for (int x = r.x0; x < r.x1; ++x)
        if (std::bit_cast<uint32_t>(part.channels[c].values[part.index(x, y)]) !=
            std::bit_cast<uint32_t>(whole.channels[c].values[whole.index(x, y)]))
          return false;
  return true;
}

bool all_finite(const Image& image) {
  for (const Image::Channel& channel : image.channels)
    for (const float value : channel.values)
      if (!std::isfinite(value)) return false;
  return true;
}

double mean_of(const Image& image, size_t channel = 0) {
  double sum = 0;
  for (const float value : image.channels[channel].values) sum += value;
  return sum / double(image.channels[channel].values.size());
}

std::unique_ptr<ReconstructionMethod> gaussian(bool guarded = true) {
  return std::make_unique<GaussianMethod>(guarded);
}

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

/// Errors over samples a pixel of a frame with and without the guarded filter.
void check_error_falls(DistributionFrame frame, const std::function<double(int, int)>& truth,
                       double gain_at_4) {
  double before = inf;
  for (const int samples : {4, 16, 64}) {
    frame.samples_per_pixel = samples;
    const double plain = rms_error(frame.render(nullptr), truth);
    const double filtered = rms_error(frame.render(gaussian()), truth);
    INFO(samples << " samples: " << plain << " unfiltered, " << filtered << " filtered");
    CHECK(filtered < 0.8 * plain);
    CHECK(filtered < before);
    if (samples == 4) CHECK(filtered < plain / gain_at_4);
    before = filtered;
  }
}

}  // namespace

TEST_CASE("Without effects or a method the film stands alone", "[reconstruction]") {
  DistributionFrame frame = busy_frame(40, 30);
  Film film(frame.settings.film);
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 3; ++i)
      film.add_bucket(i, j,
                      frame.bucket(PixelRect{16 * i, 16 * j, 16 * i + 16, 16 * j + 16}.intersect(
                          frame.settings.film.crop)));
  const Image expected = film.finish();
  CHECK(same_pixels(frame.render(nullptr), expected));
  frame.settings.film.groups = {&alpha_group, &depth_group};
  CHECK(frame.render(gaussian()).channels.size() == 2);  // no colour to filter
  DistributionFrame still = penumbra_frame(40, 30);
  const Image alone = still.render(nullptr);
  still.settings.features = {};
  // The scene's rays belong to the colour; with no feature on they are left out of it.
  CHECK(still.render(gaussian()).channels[0].values.size() == alone.channels[0].values.size());
}

TEST_CASE("Penumbrae: error falls with samples, textures stay", "[reconstruction]") {
  check_error_falls(
      penumbra_frame(), [](int x, int y) { return penumbra_truth(x, y, 48, 12); }, 3.0);
}

TEST_CASE("Defocus: error falls with samples", "[reconstruction]") {
  DistributionFrame frame(96, 48);
  frame.settings.features.lens = true;
  frame.shade = [](SceneSample& s) {
    set(s.base, s.x - 8 * s.u[0] < 48 ? 1.0f : 0.2f);
    s.coc[0] = s.coc[1] = 8;
  };
  check_error_falls(
      frame, [](int x, int) { return 0.2 + 0.8 * mean_ramp(48 - (x + 0.5), 8); }, 3.0);
}

TEST_CASE("Shadows out of focus are filtered along the lens", "[reconstruction]") {
  DistributionFrame frame(96, 48);
  frame.settings.features.lens = frame.settings.features.shadow = true;
  frame.shade = [](SceneSample& s) {
    const bool lit = s.x - 8 * s.u[0] < 48;  // a hard shadow on a surface that the lens blurs
    set(s.rays[0].unblocked, 1), set(s.rays[0].received, lit ? 1.0f : 0.0f);
    if (!lit) s.rays[0].slope = 0.01f;
    s.coc[0] = s.coc[1] = 8;
  };
  check_error_falls(
      frame, [](int x, int) { return mean_ramp(48 - (x + 0.5), 8); }, 3.0);
}

TEST_CASE("Bounces: error falls with samples", "[reconstruction]") {
  DistributionFrame frame(64, 64);
  frame.settings.features.bounce = true;
  frame.shade = [](SceneSample& s) {
    SceneSample::Ray& ray = s.rays[1];
    set(ray.unblocked, checks(s.x, s.y));
    set(ray.received, checks(s.x, s.y) * (1 + std::sin(0.3f * (s.x + 15 * ray.y[0]) +
                                                       0.2f * (s.y + 15 * ray.y[1]))));
    ray.slope = 1, ray.extent[0] = ray.extent[1] = 15;
  };
  const auto sinc = [](double a) { return std::sin(a) / a; };
  check_error_falls(
      frame,
      [&](int x, int y) {
        return checks(float(x), float(y)) *
               (1 + std::sin(0.3 * (x + 0.5) + 0.2 * (y + 0.5)) * sinc(4.5) * sinc(3.0) *
                        sinc(0.15) * sinc(0.1));
      },
      5.0);
}

TEST_CASE("Motion: error falls with samples, whatever the direction", "[reconstruction]") {
  const float angle_radians = GENERATE(0.0f, 0.6f, 2.2f);
  const float dx = std::cos(angle_radians), dy = std::sin(angle_radians);
  DistributionFrame frame(64, 64);
  frame.settings.features.motion = true;
  frame.shade = [=](SceneSample& s) {
    s.velocity[0] = 14 * dx, s.velocity[1] = 14 * dy;
    const float along = (s.x - 32) * dx + (s.y - 32) * dy - 14 * (s.t - 0.5f);
    set(s.base, along < 0 ? 1.0f : 0.2f);
  };
  // The pixel is a square whichever way the edge runs: its mean by summing over the pixel.
  const auto truth = [=](int x, int y) {
    double sum = 0;
    for (int k = 0; k < 64; ++k) {
      const double along = (x + (k % 8 + 0.5) / 8 - 32) * dx + (y + (k / 8 + 0.5) / 8 - 32) * dy;
      sum += std::clamp(0.5 - along / 14, 0.0, 1.0);
    }
    return 0.2 + 0.8 * sum / 64;
  };
  check_error_falls(frame, truth, 2.0);
}

TEST_CASE("Crops, buckets and threads change no pixel", "[reconstruction]") {
  // Wide enough for the last taps to count.
  const bool guarded = GENERATE(false, true);
  const auto wide = [=] { return std::make_unique<GaussianMethod>(guarded, 3.0f); };
  DistributionFrame frame = busy_frame(90, 60);
  const Image whole = frame.render(wide());
  frame.settings.film.bucket_size = 11;
  CHECK(same_pixels(frame.render(wide(), 5, 2), whole));
  frame.settings.film.bucket_size = 16;
  const PixelRect window = frame.settings.film.display_window;
  for (const PixelRect& crop : {PixelRect{37, 25, 50, 34}, PixelRect{0, 40, 30, 60}}) {
    frame.settings.film.crop = crop;
    frame.settings.film.sampled =
        sampled_pixels(crop.grown(reconstruction_reach(*wide())).intersect(window), window, 2, 2);
    const Image part = frame.render(wide());
    CHECK(part.data_window == crop);
    CHECK(same_pixels(part, whole));
  }
}

TEST_CASE("Filters keep the mean of a frame", "[reconstruction]") {
  const bool guarded = GENERATE(false, true);
  DistributionFrame frame = busy_frame(96, 96);
  CHECK(mean_of(frame.render(gaussian(guarded))) ==
        Approx(mean_of(frame.render(nullptr))).epsilon(0.01));
}

TEST_CASE("Alpha and depth pass as the film makes them", "[reconstruction]") {
  DistributionFrame frame = busy_frame(50, 40);
  const auto shade = frame.shade;
  frame.shade = [=](SceneSample& s) { shade(s), s.alpha = s.u[0], s.z = s.t; };
  const Image plain = frame.render(nullptr), filtered = frame.render(gaussian());
  CHECK(filtered.channels[3].values == plain.channels[3].values);
  CHECK(filtered.channels[4].values == plain.channels[4].values);
  CHECK(filtered.channels[0].values != plain.channels[0].values);
}

TEST_CASE("Exposure comes after filtering; direct and indirect light stay linear",
          "[reconstruction]") {
  DistributionFrame frame = busy_frame(50, 40);
  frame.settings.film.groups = {&alpha_group, &rgb_group, &direct_group, &indirect_group};
  const Image linear = frame.render(gaussian());
  frame.settings.film.exposure_gain = 2, frame.settings.film.exposure_gamma = 2.2f;
  const Image exposed_image = frame.render(gaussian());
  for (size_t c = 1; c < 4; ++c) {
    for (size_t p = 0; p < linear.channels[c].values.size(); ++p) {
      const double value = linear.channels[c].values[p];
      const double parts =
          double(linear.channels[c + 3].values[p]) + linear.channels[c + 6].values[p];
      REQUIRE(parts == Approx(value).margin(1e-6));
      REQUIRE(exposed_image.channels[c].values[p] ==
              Approx(std::pow(2 * value, 1 / 2.2)).epsilon(1e-5));
    }
    CHECK(exposed_image.channels[c + 3].values == linear.channels[c + 3].values);
  }
  CHECK(mean_of(linear, 7) > 0.1);  // there is indirect light
}

TEST_CASE("Fireflies stay where they are", "[reconstruction]") {
  const bool guarded = GENERATE(false, true);
  DistributionFrame frame = busy_frame(64, 64);
  frame.samples_per_pixel = 8;
  const auto shade = frame.shade;
  const Image without = frame.render(gaussian(guarded));
  const float fire = GENERATE(1e5f, 1e30f);
  frame.shade = [=](SceneSample& s) {
    shade(s);
    if (s.x > 30 && s.x < 31 && s.y > 33 && s.y < 34 && s.t < 0.12f)
      set(s.rays[1].received, fire), s.rays[1].slope = 1;
  };
  const Image plain = frame.render(nullptr), with = frame.render(gaussian(guarded));
  CHECK(all_finite(with));
  REQUIRE(mean_of(plain) > 1e-4 * fire / (64 * 64));  // it is there
  CHECK(mean_of(with) == Approx(mean_of(plain)).epsilon(0.01));
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      const size_t p = with.index(x, y);
      if (std::abs(x - 30) > 1 || std::abs(y - 33) > 1)
        REQUIRE(std::abs(with.channels[0].values[p] - without.channels[0].values[p]) < 0.2f);
    }
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
  const Image plain = frame.render(nullptr), filtered = frame.render(gaussian());
  const size_t at = plain.index(30, 30);
  float most = 0;
  for (const float value : filtered.channels[0].values) most = std::max(most, value);
  REQUIRE(mean_of(plain) > 0);
  CHECK(most < 0.05f);
  CHECK(filtered.channels[0].values[at] > 0);
  CHECK(mean_of(filtered) == Approx(mean_of(plain)).epsilon(0.01));
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
    facts.add(frame.bucket(frame.settings.film.crop), 1);
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
  const auto cut_short = make_reconstruction(frame.settings, gaussian());
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

TEST_CASE("Nothing changes where nothing is noisy", "[reconstruction]") {
  DistributionFrame frame = penumbra_frame(40, 30);
  frame.shade = [](SceneSample& s) { shade_penumbra(s, 1000, 12); };  // all lit
  const Image plain = frame.render(nullptr), filtered = frame.render(gaussian());
  for (size_t p = 0; p < plain.channels[0].values.size(); ++p)
    REQUIRE(filtered.channels[0].values[p] == Approx(plain.channels[0].values[p]).epsilon(1e-6));
}

TEST_CASE("Too many moments for the memory are refused", "[reconstruction]") {
  DistributionFrame frame = busy_frame(40, 30);
  frame.settings.memory_bytes = 1000;
  CHECK_THROWS_WITH(frame.render(gaussian()), Catch::Contains("moments for each of 1200 pixels") &&
                                                  Catch::Contains("fewer components"));
}

TEST_CASE("Methods are found by name", "[reconstruction]") {
  const ReconstructionMethodDefinition methods[] = {
      {"narrow", "", [](std::string_view) { return gaussian(false); }},
      {"wide", "", [](std::string_view arguments) -> std::unique_ptr<ReconstructionMethod> {
         if (arguments != "3") throw Error("expected 3");
         return gaussian(true);
       }}};
  CHECK(make_method("filter", methods) == nullptr);
  CHECK_FALSE(make_method("narrow", methods)->guarded());
  CHECK(make_method("wide:3", methods)->guarded());
  CHECK_THROWS_WITH(make_method("wide", methods), "expected 3");
  CHECK_THROWS_WITH(make_method("filter:2", methods), Catch::Contains("takes no arguments"));
  CHECK_THROWS_WITH(make_method("wid", methods), Catch::Contains("filter, narrow, wide"));
}
