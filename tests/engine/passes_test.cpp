// What frames of several passes say of themselves while they are rendered and when they are
// cancelled.

#include <catch2/catch.hpp>

#include "engine/frame_files.h"
#include "tests/engine/render_text.h"
#include "tests/engine/scene_text.h"

using namespace tessera;

namespace {

struct Watched {
  FrameResult frame;
  std::vector<FrameProgress> progress;
};

// Cancels when a bucket of pass `last_pass` is done.
Watched render_watched(const Settings& settings, int last_pass = 1000) {
  Diagnostics diagnostics;
  SceneCollector sink;
  read_rib_text(sphere_scene(), "test.rib", sink, diagnostics);
  std::atomic<bool> cancel = false;
  Watched watched;
  FrameControl control;
  control.cancel = &cancel;
  control.progress = [&](const FrameProgress& progress) {
    watched.progress.push_back(progress);
    if (progress.pass == last_pass && progress.buckets_done > 0) cancel = true;
  };
  watched.frame = render_frame(*sink.scenes.front(), settings, diagnostics, control);
  return watched;
}

Settings several(std::vector<double> rounds, std::vector<int> passes) {
  Settings settings;
  settings.threads = 1, settings.bucket_size = 8;
  settings.rounds = std::move(rounds), settings.passes = std::move(passes);
  return settings;
}

}  // namespace

TEST_CASE("passes are counted, and each tells of every bucket") {
  const auto counted = [](const Settings& settings, int passes, int known) {
    const std::vector<FrameProgress> progress = render_watched(settings).progress;
    const int buckets = 4 * 3;
    REQUIRE(progress.size() == size_t(passes * (buckets + 1)));
    for (size_t i = 0; i < progress.size(); ++i) {
      CHECK(progress[i].pass == 1 + int(i) / (buckets + 1));
      CHECK(progress[i].buckets_done == int(i) % (buckets + 1));
      CHECK(progress[i].buckets_total == buckets);
      CHECK(progress[i].passes == known);
    }
  };
  Settings one = several({}, {});
  counted(one, 1, 1);
  counted(several({}, {2, 4, 4}), 3, 3);
  counted(several({2, 4}, {}), 4, 4);
  one.error = 1e3;
  counted(one, 2, 0);
}

TEST_CASE("a cancelled frame is whole when a pass before was") {
  for (const Settings& settings : {several({2, 4}, {}), several({}, {2, 4, 4})}) {
    const FrameResult first = render_watched(settings, 1).frame;
    CHECK_FALSE(first.complete);
    CHECK_FALSE(first.whole);
    CHECK(is_interrupted(first.image));
    // One of two passes that make a round is a whole image, too.
    CHECK(render_watched(settings, 2).frame.whole);
    CHECK_FALSE(render_watched(settings, 2).frame.complete);
    const FrameResult third = render_watched(settings, 3).frame;
    CHECK_FALSE(third.complete);
    CHECK(third.whole);
    CHECK(is_interrupted(third.image));
    CHECK(channel_at(third.image, "A", 16, 12) == 1);
    CHECK(channel_at(first.image, "A", 16, 12) == 0);
    const FrameResult all = render_watched(settings).frame;
    CHECK(all.complete);
    CHECK(all.whole);
    CHECK_FALSE(is_interrupted(all.image));
  }
}
