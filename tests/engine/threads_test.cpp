// As many threads as are asked for, more than there are cores included.

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

#include <catch2/catch.hpp>

#include "tests/engine/program.h"
#include "tests/engine/render_text.h"
#include "tests/engine/scene_text.h"

using namespace tessera;

namespace {

// Lets workers into shade() only when `wanted` of them are there, or after so long that they will
// not come.
class Gathering {
 public:
  explicit Gathering(int wanted) : wanted_(wanted) {}

  void wait() {
    std::unique_lock lock(mutex_);
    most_ = std::max(most_, ++present_);
    if (most_ >= wanted_) all_came_.notify_all();
    all_came_.wait_for(lock, std::chrono::seconds(given_up_ ? 0 : 5),
                       [&] { return most_ >= wanted_; });
    given_up_ = most_ < wanted_;
    --present_;
  }
  int most() const { return most_; }

 private:
  const int wanted_;
  std::mutex mutex_;
  std::condition_variable all_came_;
  int present_ = 0, most_ = 0;
  bool given_up_ = false;
};

class GatheringShading final : public Shading {
 public:
  GatheringShading(std::unique_ptr<Shading> shading, Gathering& gathering)
      : shading_(std::move(shading)), gathering_(gathering) {}

  void shade(const ShadeInput& input, ShadedFragments& out, ShadeCounters& counters) override {
    gathering_.wait();
    shading_->shade(input, out, counters);
  }
  void requests(const ShadeInput& input, size_t fragment,
                std::vector<ShadingRequest>& out) override {
    shading_->requests(input, fragment, out);
  }

 private:
  std::unique_ptr<Shading> shading_;
  Gathering& gathering_;
};

}  // namespace

TEST_CASE("a frame runs as many threads as it is asked for, however few cores there are") {
  const int asked = int(std::thread::hardware_concurrency()) + 3;
  Gathering gathering(asked);
  FrameControl control;
  control.make_shading = [&](std::string_view spec, const ShadingFrame& frame) {
    return std::make_unique<GatheringShading>(make_shading(spec, frame), gathering);
  };
  Settings settings;
  settings.threads = asked, settings.bucket_size = 4;
  Diagnostics diagnostics;
  SceneCollector sink;
  read_rib_text(sphere_scene(), "test.rib", sink, diagnostics);
  render_frame(*sink.scenes.front(), settings, diagnostics, control);
  CHECK(gathering.most() == asked);
}

TEST_CASE("nothing is said of threads that share cores") {
  const TemporaryFolder folder;
  folder.write("s.rib", sphere_scene());
  const std::string threads = std::to_string(std::thread::hardware_concurrency() + 3);
  const ProgramResult result =
      run_tessera({"render", "s.rib", "--quiet", "--threads", threads}, folder);
  CHECK(result.exit_code == 0);
  CHECK(result.err == "");
}
