#pragma once
/// Scenes from generated text.

#include <memory>
#include <string>

#include "base/error.h"
#include "scenes/rib/rib_reader.h"

namespace tessera {

/// Keeps the last frame that is read.
struct LastFrame : SceneSink {
  bool frame(std::unique_ptr<const Scene> read) override {
    scene = std::move(read);
    return true;
  }
  std::unique_ptr<const Scene> scene;
};

/// The last frame of `text`. Throws Error, with `name` as the file, if there is none, and on
/// anything that the reader warns of: generated scenes are to be as they are written.
inline std::unique_ptr<const Scene> read_generated_scene(const std::string& text,
                                                         const std::string& name) {
  LastFrame sink;
  Diagnostics diagnostics;
  read_rib_text(text, name, sink, diagnostics);
  if (!sink.scene) throw Error(fmt::format("scene {} holds no frame", name));
  if (!diagnostics.lines().empty()) throw Error(diagnostics.lines().front());
  return std::move(sink.scene);
}

}  // namespace tessera
