#pragma once
// Renders scene text to an image in memory.

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "engine/frame.h"
#include "scenes/rib/rib_reader.h"

namespace tessera {

class SceneCollector : public SceneSink {
 public:
  bool frame(std::unique_ptr<const Scene> scene) override {
    scenes.push_back(std::move(scene));
    return true;
  }
  std::vector<std::unique_ptr<const Scene>> scenes;
};

inline FrameResult render_text_frame(std::string_view rib, const Settings& settings = {}) {
  Diagnostics diagnostics;
  SceneCollector sink;
  read_rib_text(rib, "test.rib", sink, diagnostics);
  if (sink.scenes.empty()) throw Error("the test scene holds no frame");
  return render_frame(*sink.scenes.front(), settings, diagnostics);
}

inline Image render_text(std::string_view rib, const Settings& settings = {}) {
  return render_text_frame(rib, settings).image;
}

// The value of a channel at pixel (x, y) of the frame.
inline float channel_at(const Image& image, std::string_view name, int x, int y) {
  const Image::Channel* channel = image.find_channel(name);
  if (!channel) throw Error(fmt::format("no channel {}", name));
  return channel->values[image.index(x, y)];
}

}  // namespace tessera
