// Requests of shading modes as the shading benchmark replays them.

#include <catch2/catch.hpp>

#include <algorithm>
#include <list>
#include <random>

#include "bench/shading_replay.h"
#include "tests/engine/render_text.h"
#include "tests/engine/scene_text.h"

using namespace tessera;

namespace {

uint64_t misses_of_list(const std::vector<uint64_t>& names, size_t entries) {
  std::list<uint64_t> cache;
  uint64_t misses = 0;
  for (const uint64_t name : names) {
    const auto found = std::find(cache.begin(), cache.end(), name);
    if (found == cache.end())
      ++misses;
    else
      cache.erase(found);
    cache.push_front(name);
    if (cache.size() > entries) cache.pop_back();
  }
  return misses;
}

/// Renders with replays in place of shading, on one thread.
void replay(std::vector<ModeReplay>& replays, int bucket_size = 16) {
  SceneCollector sink;
  Diagnostics diagnostics;
  read_rib_text(everything_scene(), "test.rib", sink, diagnostics);
  Settings settings;
  settings.threads = 1;
  settings.bucket_size = bucket_size;
  FrameControl control;
  control.make_shading = [&](std::string_view, const ShadingFrame& frame) {
    return std::make_unique<ReplayShading>(frame, replays);
  };
  render_frame(*sink.scenes.front(), settings, diagnostics, control);
}

ModeReplay replay_of(const std::string& mode) {
  return {mode, CacheBank({16, 64}), CacheBank({16, 64})};
}

/// Keeps where buckets lie and what is asked for in them.
class Recorder : public Shading {
 public:
  Recorder(std::unique_ptr<Shading> inner, std::vector<PixelRect>& rects,
           std::vector<uint64_t>& points)
      : inner_(std::move(inner)), rects_(rects), points_(points) {}
  void shade(const ShadeInput& input, ShadedFragments& out, ShadeCounters& counters) override {
    rects_.push_back(input.samples->rect);
    std::vector<ShadingRequest> requests;
    for (const uint32_t f : fragments_in_order(input)) inner_->requests(input, f, requests);
    for (const ShadingRequest& request : requests) points_.push_back(request.point);
    inner_->shade(input, out, counters);
  }
  void requests(const ShadeInput& input, size_t f, std::vector<ShadingRequest>& out) override {
    inner_->requests(input, f, out);
  }

 private:
  std::unique_ptr<Shading> inner_;
  std::vector<PixelRect>& rects_;
  std::vector<uint64_t>& points_;
};

}  // namespace

TEST_CASE("a bank of caches counts what separate caches would") {
  std::mt19937 random(1);
  std::vector<uint64_t> names;
  for (int i = 0; i < 3000; ++i)
    for (uint64_t k = random() % 3, name = uint64_t(i / 30) + random() % 40; k < 3; ++k)
      names.push_back(name);
  CacheBank bank({4, 16});
  // In pieces, as buckets come.
  for (size_t i = 0; i < names.size(); i += 100)
    bank.replay(std::span(names).subspan(i, std::min<size_t>(100, names.size() - i)));
  CHECK(bank.shaded(0) == misses_of_list(names, 4));
  CHECK(bank.shaded(1) == misses_of_list(names, 16));
  CHECK(bank.shaded_unbounded() == misses_of_list(names, names.size()));
  CHECK(bank.shaded(0) > bank.shaded(1));
}

TEST_CASE("a rasteriser takes tiles, blocks, pixels, samples") {
  SampleBlock samples;
  samples.rect = {3, 5, 3 + 10, 5 + 9};  // the tiles at the right and the bottom are cut
  samples.samples_per_pixel = 2;
  const std::vector<uint32_t> order = rasteriser_order(samples);
  const auto at = [](uint32_t x, uint32_t y) { return (y * 10 + x) * 2; };
  const std::vector<uint32_t> first{at(0, 0), at(0, 0) + 1, at(1, 0), at(1, 0) + 1,
                                    at(0, 1), at(0, 1) + 1, at(1, 1), at(1, 1) + 1,
                                    at(2, 0), at(2, 0) + 1};
  REQUIRE(order.size() == 180);
  CHECK(std::equal(first.begin(), first.end(), order.begin()));
  CHECK(order[128] == at(8, 0));       // the second tile
  CHECK(order[128 + 32] == at(0, 8));  // the third, two pixels wide the second was
  std::vector<uint32_t> sorted = order;
  std::ranges::sort(sorted);
  for (uint32_t i = 0; i < 180; ++i) REQUIRE(sorted[i] == i);
}

TEST_CASE("fragments are ordered by grid and then as a rasteriser meets their samples") {
  SampleBlock samples;
  samples.rect = {0, 0, 4, 1};
  samples.samples_per_pixel = 1;
  FragmentList fragments;
  // Samples 0 and 1 see grid 1, sample 2 sees grid 1 before grid 0, sample 3 nothing.
  fragments.sample = {0, 1, 2, 2}, fragments.grid = {1, 1, 1, 0};
  fragments.first_of_sample = {0, 1, 2, 4, 4};
  const std::vector<std::shared_ptr<const Grid>> grids(2, std::make_shared<Grid>());
  const ShadeInput input{&fragments, grids, &samples};
  CHECK(fragments_in_order(input) == std::vector<uint32_t>{3, 0, 1, 2});
}

TEST_CASE("modes replayed together count as each alone") {
  std::vector<ModeReplay> together;
  for (const ShadingModeDefinition& mode : shading_mode_registry())
    together.push_back(replay_of(mode.name));
  replay(together);
  for (const ModeReplay& replayed : together) {
    INFO(replayed.mode);
    std::vector<ModeReplay> alone{replay_of(replayed.mode)};
    replay(alone);
    for (size_t c = 0; c < 2; ++c) {
      CHECK(replayed.points.shaded(c) == alone[0].points.shaded(c));
      CHECK(replayed.quads.shaded(c) == alone[0].quads.shaded(c));
    }
    CHECK(replayed.points.shaded_unbounded() == alone[0].points.shaded_unbounded());
    CHECK(replayed.points.shaded_unbounded() > 0);
    CHECK(replayed.quads.shaded_unbounded() <= replayed.points.shaded_unbounded());
    // Larger buckets make for fewer returns to a grid, but ask for the same.
    std::vector<ModeReplay> larger{replay_of(replayed.mode)};
    replay(larger, 64);
    CHECK(larger[0].points.shaded_unbounded() == replayed.points.shaded_unbounded());
  }
}

TEST_CASE("on one thread the shading of a measurement sees the buckets in raster order") {
  SceneCollector sink;
  Diagnostics diagnostics;
  read_rib_text(everything_scene(), "test.rib", sink, diagnostics);
  Settings settings;
  settings.threads = 1;
  settings.shading = "reyes";
  std::vector<PixelRect> rects;
  std::vector<uint64_t> points;
  FrameControl control;
  control.make_shading = [&](std::string_view spec, const ShadingFrame& frame) {
    CHECK(spec == "reyes");
    return std::make_unique<Recorder>(make_shading(spec, frame), rects, points);
  };
  const FrameResult watched = render_frame(*sink.scenes.front(), settings, diagnostics, control);
  REQUIRE(rects.size() > 4);
  CHECK(std::ranges::is_sorted(rects, [](const PixelRect& a, const PixelRect& b) {
    return std::pair(a.y0, a.x0) < std::pair(b.y0, b.x0);
  }));
  // Whoever watches does not change the picture.
  const FrameResult plain = render_frame(*sink.scenes.front(), settings, diagnostics);
  CHECK(watched.image.find_channel("R")->values == plain.image.find_channel("R")->values);

  // What the replay counts is what is asked for.
  std::vector<ModeReplay> replays{replay_of("reyes")};
  replay(replays, 32);
  CHECK(replays[0].points.shaded(0) == misses_of_list(points, 16));
  CHECK(replays[0].points.shaded(1) == misses_of_list(points, 64));
}
