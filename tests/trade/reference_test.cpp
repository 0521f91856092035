// The reference's own error, and references of other scenes.

#include <atomic>
#include <filesystem>
#include <random>

#include <catch2/catch.hpp>

#include "base/error.h"
#include "images/exr.h"
#include "tests/trade/trade_fixtures.h"
#include "trade/content_hash.h"
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

TEST_CASE("what a reference takes is predicted from what its halves take whatever their samples") {
  // A half of n samples takes 0.5 s and 0.02 s for each.
  const std::vector<Pilot> pilots{{2, 0.54}, {8, 0.66}};
  CHECK(predict_reference_s(pilots, 256) == Approx(2 * (0.5 + 128 * 0.02)));
  CHECK(predict_reference_s(pilots, 1) == Approx(2 * (0.5 + 0.02)));
  // From one pilot all is for samples; a difference that is noise does not make samples free.
  CHECK(predict_reference_s({{2, 0.54}}, 256) == Approx(128 * 0.54));
  CHECK(predict_reference_s({{2, 0.7}, {8, 0.64}}, 256) == Approx(2 * (0.576 + 128 * 0.008)));
  // Nor more expensive than all of the time.
  CHECK(predict_reference_s({{2, 0.1}, {8, 0.64}}, 256) == Approx(2 * 128 * 0.08));
}

TEST_CASE("an interrupted reference keeps its first half, and another takes it from there") {
  const TestFolder folder;
  // A renderer that copies an image made for its seed, and has no time for the second half at
  // first.
  write_exr(folder / "1013904223", grey(4, 2, 0.25f));
  const std::string program =
      folder.write("renderer",
                   "#!/bin/sh\ncase $* in *--help*|*--version*) exit 0;; esac\n"
                   "for seed in $*; do :; done\necho $seed >> " +
                       (folder / "log") + "\ncp " + (folder / "$seed") +
                       " $4 && echo '{\"times_s\":{\"frame_s\":2}}' > $6\n");
  std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  const std::atomic<bool> cancel = false;
  const Renderer renderer(program, "s.rib", {}, 60, &cancel);
  ReferenceRequest request;
  request.spp = 8;
  request.cache = folder / "cache";
  request.folder = folder / "";
  request.left_s = [] { return 60.0; };
  request.say = [](const std::string&) {};
  CHECK_THROWS_AS(make_reference(renderer, request), Error);
  CHECK_FALSE(is_cached(renderer, request));
  write_exr(folder / "1664525", grey(4, 2, 0.75f));
  const Reference reference = make_reference(renderer, request);
  CHECK(text_in(folder / "log") == "1013904223\n1664525\n1664525\n");
  CHECK(read_exr(reference.file).channels[0].values[0] == 0.5f);
  CHECK(reference.frame_s == 4);
  CHECK(reference.spp == 8);
  CHECK(is_cached(renderer, request));
  // Nothing but the reference is left.
  CHECK(std::distance(std::filesystem::directory_iterator(folder / "cache"), {}) == 1);

  const std::string hash = hash_pixels(read_exr(reference.file));
  const auto kept = kept_reference(renderer, reference.file, hash);
  REQUIRE(kept);
  CHECK(kept->options == reference.options);
  CHECK_FALSE(kept_reference(renderer, reference.file, "0123"));
  CHECK_FALSE(kept_reference(renderer, folder / "none", hash));
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
