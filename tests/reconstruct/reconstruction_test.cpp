#include <catch2/catch.hpp>

#include "base/error.h"
#include "tests/reconstruct/distribution_frames.h"

using namespace tessera;
using namespace tessera::test;

namespace {

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

TEST_CASE("Nothing changes where nothing is noisy", "[reconstruction]") {
  DistributionFrame frame = penumbra_frame(40, 30);
  frame.shade = [](SceneSample& s) { shade_penumbra(s, 1000, 12); };  // all lit
  const Image plain = frame.render(nullptr), filtered = frame.render(gaussian());
  for (size_t p = 0; p < plain.channels[0].values.size(); ++p)
    REQUIRE(filtered.channels[0].values[p] == Approx(plain.channels[0].values[p]).epsilon(1e-6));
}

namespace {

/// A surface of checks wholly lit by a light some of whose places shine ninety times brighter than
/// the others.
DistributionFrame uneven_light(bool has_drawn) {
  DistributionFrame frame(48, 36);
  frame.settings.features.shadow = true;
  frame.has_drawn = has_drawn;
  frame.shade = [](SceneSample& s) {
    SceneSample::Ray& ray = s.rays[0];
    const float place = ray.y[0] > 0.8f ? 9.0f : 0.1f;  // a tenth of them: 0.99 in the mean
    set(ray.unblocked, checks(s.x, s.y));
    set(ray.drawn, place * checks(s.x, s.y)), set(ray.received, place * checks(s.x, s.y));
    ray.extent[0] = ray.extent[1] = 8;
    ray.slope = s.x < 24 ? std::numeric_limits<float>::quiet_NaN() : 0.5f;
  };
  return frame;
}

}  // namespace

TEST_CASE("Where nothing is in the way, uneven places of a light make little noise",
          "[reconstruction]") {
  const bool guarded = GENERATE(false, true);
  const DistributionFrame frame = uneven_light(true);
  const auto truth = [](int x, int y) { return double(checks(float(x), float(y))); };
  const double plain = rms_error(frame.render(nullptr), truth);
  CHECK(plain > 0.5);
  // The guard cannot always tell the noise of so uneven a light from a difference.
  CHECK(rms_error(frame.render(gaussian(guarded)), truth) < 0.2 * plain);
  // Shadows that cannot be told from places have the noise of both.
  CHECK(rms_error(uneven_light(false).render(gaussian(guarded)), truth) > 0.2 * plain);
}

TEST_CASE("What cells say of the light gives way to the samples as these grow",
          "[reconstruction]") {
  const bool guarded = GENERATE(false, true);
  // Wholly lit: cells say 1.2, samples' places 1 in the mean, from 0.5 to 1.5.
  DistributionFrame frame(32, 32);
  frame.settings.features.shadow = frame.has_drawn = true;
  frame.shade = [](SceneSample& s) {
    const float place = 1 + 0.5f * s.rays[0].y[0];
    set(s.rays[0].unblocked, 1.2f), set(s.rays[0].drawn, place), set(s.rays[0].received, place);
  };
  double before = inf;
  for (const int samples : {4, 16, 64, 256}) {
    frame.samples_per_pixel = samples;
    const auto error = [](const Image& image) {
      return rms_error(image, [](int, int) { return 1.0; });
    };
    const double plain = error(frame.render(nullptr));
    const double filtered = error(frame.render(gaussian(guarded)));
    CAPTURE(samples, plain, filtered);
    CHECK(filtered < 1.3 * plain);
    CHECK(filtered < before);
    before = filtered;
  }
}

TEST_CASE("The noise of places is left out of penumbrae, their mean stays", "[reconstruction]") {
  DistributionFrame frame = penumbra_frame();
  frame.shade = [](SceneSample& s) {
    shade_penumbra(s, 48, 12);
    // Bright along one axis, dark along the other, which says nothing of the shadow.
    const float place = 1 + 0.95f * (s.rays[0].y[1] > 0 ? 1.0f : -1.0f);
    for (size_t c = 0; c < 3; ++c) {
      s.rays[0].drawn[c] = place * s.rays[0].unblocked[c];
      s.rays[0].received[c] *= place;
    }
  };
  const auto truth = [](int x, int y) { return penumbra_truth(x, y, 48, 12); };
  const double blind = rms_error(frame.render(gaussian()), truth);
  frame.has_drawn = true;
  const Image image = frame.render(gaussian());
  INFO(rms_error(image, truth) << " against " << blind << " without");
  CHECK(rms_error(image, truth) < 0.8 * blind);
  double mean = 0;
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 96; ++x) mean += truth(x, y) / (96 * 48);
  CHECK(mean_of(image) == Approx(mean).epsilon(0.01));
}

TEST_CASE("Too many moments for the memory are refused", "[reconstruction]") {
  DistributionFrame frame = busy_frame(40, 30);
  ReconstructionSettings& settings = frame.settings;
  CHECK(reconstruction_bytes(settings) == 0);  // the film alone
  settings.method = gaussian();
  const size_t bytes = reconstruction_bytes(settings);
  CHECK(bytes > size_t(40 * 30) * 88 * sizeof(float));
  settings.memory_bytes = bytes;
  CHECK(make_reconstruction(settings));
  settings.memory_bytes = bytes - 1;
  CHECK_THROWS_WITH(make_reconstruction(settings),
                    Catch::Contains("for 40 x 30 pixels") && Catch::Contains("fewer components"));
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
