// The reference's own error, and references of other scenes.

#include <random>

#include <catch2/catch.hpp>

#include "base/error.h"
#include "images/exr.h"
#include "tests/trade/trade_fixtures.h"
#include "trade/measure.h"
#include "trade/process.h"
#include "trade/reference.h"

using namespace tessera;
using namespace tessera::trade;
using Catch::Contains;

namespace {

Image grey(int width, int height, float value) {
  Image image(width, height);
  for (const char* name : {"R", "G", "B"})
    image.add_channel(name).values.assign(size_t(width * height), value);
  return image;
}

}  // namespace

TEST_CASE("two halves tell the error of their mean") {
  // Noise of standard deviation s about 0.5 in each half: the mean's variance is s^2 / 2, and its
  // relMSE s^2 / 2 / (0.25 + 0.01). Measured against the truth, which the halves do not know.
  const double s = 0.02;
  Image a = grey(128, 128, 0), b = a;
  std::mt19937 random(3);
  std::normal_distribution<float> noise(0.5f, float(s));
  for (Image* image : {&a, &b})
    for (Image::Channel& channel : image->channels)
      for (float& value : channel.values) value = noise(random);
  const MeanOfTwo mean = mean_of_two(a, b);
  const double expected = s * s / 2 / 0.26;
  CHECK(mean.rel_mse == Approx(expected).epsilon(0.03));
  CHECK(error_of(mean.image, grey(128, 128, 0.5f)).rel_mse == Approx(expected).epsilon(0.03));
}

TEST_CASE("a given reference has to be of the scene") {
  const TestFolder folder;
  Image image = grey(8, 4, 0.5f);
  image.metadata = {{"tessera:scene", "scenes/a.rib"}, {"tessera:option:shutter", "0 1 box"}};
  const std::string probe = folder / "probe.exr", file = folder / "reference.exr";
  write_exr(probe, image);
  const auto take = [&](const Image& reference) {
    write_exr(file, reference);
    return take_reference(file, probe, "0123");
  };
  CHECK(take(image).file == file);
  Image other = image;
  other.metadata["tessera:scene"] = "elsewhere/a.rib";
  CHECK_NOTHROW(take(other));
  other.metadata["tessera:scene"] = "scenes/b.rib";
  CHECK_THROWS_WITH(take(other), Contains("'b.rib', expected 'a.rib'"));
  other = image;
  other.metadata["tessera:trade:scene_hash"] = "4567";
  CHECK_THROWS_WITH(take(other), Contains("scene hash"));
  other = image;
  other.metadata["tessera:option:shutter"] = "0 0.5 box";
  CHECK_THROWS_WITH(take(other), Contains("shutter"));
  CHECK_THROWS_WITH(take(grey(8, 5, 0.5f)), Contains("picture"));
  Image cropped(image.display_window, PixelRect{0, 0, 4, 4});
  for (const char* name : {"R", "G", "B"}) cropped.add_channel(name);
  CHECK_THROWS_WITH(take(cropped), Contains("crop"));
  Image flat(8, 4);
  flat.add_channel("Z");
  CHECK_THROWS_WITH(take(flat), Contains("no channel R"));
}

TEST_CASE("what every run is given anyway is not given to the reference twice") {
  const auto options = reference_options({"--shading", "ds"});
  CHECK(options == std::vector<std::string>{"--reconstruct", "filter", "--dicing-rate", "0.25",
                                            "--ray-dicing-rate", "1"});
}

TEST_CASE("processes are measured, and how they end is told") {
  const TestFolder folder;
  const std::string log = folder / "log";
  const auto shell = [&](const std::string& script, double timeout_s = 60) {
    ProcessLimits limits;
    limits.timeout_s = timeout_s;
    return run_process({"/bin/sh", "-c", script}, log, limits);
  };
  const ProcessResult good = shell("echo said; echo wrong >&2");
  CHECK(good.ok());
  CHECK(good.output == "said\nwrong\n");
  CHECK(good.peak_bytes > 0);
  CHECK(shell("echo 'error: no such thing' >&2; exit 3").failure() == "no such thing");
  CHECK(shell("exit 3").failure() == "ended with exit code 3");
  CHECK_THAT(shell("kill -SEGV $$").failure(), Contains("signal 11"));
  const ProcessResult slow = shell("sleep 100", 0.05);
  CHECK(slow.timed_out);
  CHECK_THAT(slow.failure(), Contains("time limit"));
  const std::atomic<bool> cancel = true;
  CHECK(run_process({"/bin/sleep", "100"}, log, {60, &cancel}).cancelled);
  CHECK_THROWS_WITH(run_process({folder / "none"}, log), Contains("cannot run"));
}
