#pragma once
/// Where a scene reader delivers its frames, one at a time, so that a file of a thousand frames
/// never holds more than one.

#include <memory>

#include "scenes/scene.h"

namespace tessera {

class SceneSink {
 public:
  virtual ~SceneSink() = default;
  /// Called at the end of each world. Returns false to stop reading.
  virtual bool frame(std::unique_ptr<const Scene> scene) = 0;
  /// Between frames: the depth file `picture`, which one of the frames before may be about to
  /// write, shall also serve as the shadow map `shadow`. Unless overridden, nothing is done.
  virtual void make_shadow(const std::string& picture, const std::string& shadow,
                           const SourceLocation& where) {
    (void)picture, (void)shadow, (void)where;
  }
};

}  // namespace tessera
